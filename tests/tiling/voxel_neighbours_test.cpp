#include "tiling/voxel_neighbours.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include "core/parallel.h"
#include "tiling/morton.h"
#include "tiling/random_cloud.h"

namespace arris::tiling {
namespace {

constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();

VoxelTile linked_tile(std::vector<LatticePoint> keys) {
  std::ranges::sort(keys, z_order_less);
  const auto rest = std::ranges::unique(keys);
  keys.erase(rest.begin(), rest.end());
  VoxelIndex index;
  for (const LatticePoint& key : keys) index.append(key);
  index.finish();
  VoxelTile tile(VoxelGrid(1));
  tile.keys.assign(keys.begin(), keys.end());
  LinkBegins begins;
  link_neighbours(tile, index, begins);
  return tile;
}

/// By looking up all 26 in a map.
std::vector<std::vector<std::uint32_t>> neighbours_by_map(const VoxelTile& tile) {
  std::map<std::array<std::int64_t, 3>, std::uint32_t> at;
  for (std::uint32_t v = 0; v < tile.size(); ++v) at[{tile.keys[v].x, tile.keys[v].y, tile.keys[v].z}] = v;
  std::vector<std::vector<std::uint32_t>> neighbours(tile.size());
  for (std::uint32_t v = 0; v < tile.size(); ++v) {
    for (int i = 0; i < 27; ++i) {
      const auto found =
          at.find({std::int64_t{tile.keys[v].x} + i / 9 - 1, std::int64_t{tile.keys[v].y} + i / 3 % 3 - 1,
                   std::int64_t{tile.keys[v].z} + i % 3 - 1});
      if (i != 13 && found != at.end()) neighbours[v].push_back(found->second);
    }
  }
  return neighbours;
}

std::vector<std::vector<std::uint32_t>> neighbours_of(const VoxelTile& tile) {
  std::vector<std::vector<std::uint32_t>> neighbours;
  for (std::size_t v = 0; v < tile.size(); ++v) {
    const auto these = tile.neighbours_of(v);
    neighbours.emplace_back(these.begin(), these.end());
  }
  return neighbours;
}

/// All keys of a cube of 2 n voxels a side around a corner of blocks, as far as they exist.
std::vector<LatticePoint> cube_around(std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t n) {
  std::vector<LatticePoint> keys;
  for (std::int64_t i = x - n; i < x + n; ++i) {
    for (std::int64_t j = y - n; j < y + n; ++j) {
      for (std::int64_t k = z - n; k < z + n; ++k) {
        if (std::min({i, j, k}) < kMin || std::max({i, j, k}) > kMax) continue;
        keys.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), static_cast<std::int32_t>(k)});
      }
    }
  }
  return keys;
}

RC_GTEST_PROP(VoxelNeighbours, AnyKeys_AreLinkedAsByBruteForce, ()) {
  std::vector<LatticePoint> keys = test::any_cloud(1, 1500);
  // Clouds are mostly wider than a voxel is: a dense part, so that there is something to link.
  std::mt19937_64 random(keys.size());
  const auto near = [&](std::int32_t v) {
    return test::clamp_to_int32(v + static_cast<std::int64_t>(random() % 12) - 6);
  };
  const LatticePoint middle = keys[0];
  for (int i = 0; i < 700; ++i) keys.push_back({near(middle.x), near(middle.y), near(middle.z)});
  const VoxelTile tile = linked_tile(keys);
  RC_ASSERT(neighbours_of(tile) == neighbours_by_map(tile));
}

TEST(VoxelNeighbours, FullCubeOverCornersOfBlocks_InnerVoxelsHaveAllInOrder) {
  for (const std::int64_t corner : {std::int64_t{0}, std::int64_t{8}, std::int64_t{-1024}, std::int64_t{1} << 30}) {
    const VoxelTile tile = linked_tile(cube_around(corner, -corner, corner - 8, 5));
    ASSERT_EQ(tile.size(), 1000U);
    EXPECT_EQ(neighbours_of(tile), neighbours_by_map(tile));
    EXPECT_EQ(tile.neighbours.size(), 28U * 28 * 28 - 1000U) << "8 inner voxels and 2 outer ones with 3 and 2 per axis";
  }
}

TEST(VoxelNeighbours, EndsOfInt32_HaveNoNeighboursBeyond) {
  std::vector<LatticePoint> keys;
  for (const std::int32_t x : {kMin, kMin + 1, kMax - 1, kMax}) {
    for (const std::int32_t y : {kMin, kMin + 1, kMax - 1, kMax}) {
      for (const std::int32_t z : {kMin, kMin + 1, kMax - 1, kMax}) keys.push_back({x, y, z});
    }
  }
  const VoxelTile tile = linked_tile(keys);
  EXPECT_EQ(neighbours_of(tile), neighbours_by_map(tile));
  for (std::size_t v = 0; v < tile.size(); ++v) EXPECT_EQ(tile.neighbours_of(v).size(), 7U) << "not around the world";
}

TEST(VoxelNeighbours, NoVoxels_GiveAnEmptyTable) {
  const VoxelTile tile = linked_tile({});
  EXPECT_EQ(tile.neighbour_begin, (PageVector<std::uint32_t>{0}));
  EXPECT_TRUE(tile.neighbours.empty());
}

TEST(VoxelNeighbours, AnyNumberOfThreads_GivesTheSame) {
  const std::vector<LatticePoint> keys = test::plane_grid(300, 1, -150);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return linked_tile(keys);
  };
  const VoxelTile one = with_threads(1);
  const VoxelTile four = with_threads(4);
  EXPECT_EQ(one.neighbour_begin, four.neighbour_begin);
  EXPECT_EQ(one.neighbours, four.neighbours);
}

}  // namespace
}  // namespace arris::tiling
