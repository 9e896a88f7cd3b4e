#include "tiling/voxel_index.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "tiling/morton.h"
#include "tiling/random_cloud.h"
#include "tiling/voxel_selection.h"

namespace arris::tiling {
namespace {

constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();

std::vector<LatticePoint> in_z_order(std::vector<LatticePoint> keys) {
  std::ranges::sort(keys, z_order_less);
  const auto rest = std::ranges::unique(keys);
  keys.erase(rest.begin(), rest.end());
  return keys;
}

VoxelIndex index_of(const std::vector<LatticePoint>& keys) {
  VoxelIndex index;
  for (const LatticePoint& key : keys) index.append(key);
  index.finish();
  return index;
}

LatticeBox any_box(const std::vector<LatticePoint>& keys) {
  LatticeBox box;
  box.include(keys[*rc::gen::inRange<std::size_t>(0, keys.size())]);
  box.include(keys[*rc::gen::inRange<std::size_t>(0, keys.size())]);
  return box.expanded(*rc::gen::inRange<std::int64_t>(0, 20));
}

RC_GTEST_PROP(VoxelIndex, AnyKeys_HaveTheirRanksAndOthersNone, ()) {
  const auto keys = in_z_order(test::any_cloud(1, 3000));
  const VoxelIndex index = index_of(keys);
  RC_ASSERT(index.size() == keys.size());
  LatticeBox bounds;
  for (const LatticePoint& key : keys) bounds.include(key);
  RC_ASSERT(index.bounds() == bounds);
  std::map<LatticePoint, std::uint32_t> ranks;
  for (std::size_t i = 0; i < keys.size(); ++i) ranks[keys[i]] = static_cast<std::uint32_t>(i);

  auto hint = *rc::gen::arbitrary<std::uint32_t>().as("hint");
  std::mt19937_64 random(keys.size());
  std::vector<LatticePoint> asked;
  std::vector<std::uint32_t> answers;
  for (int i = 0; i < 3000; ++i) {
    LatticePoint key = keys[random() % keys.size()];
    const auto moved = [&](std::int32_t v) {
      return test::clamp_to_int32(v + static_cast<std::int64_t>(random() % 5) - 2);
    };
    if (i % 2) key = {moved(key.x), moved(key.y), moved(key.z)};
    if (i % 16 == 7) key.y = static_cast<std::int32_t>(random());
    const auto found = ranks.find(key);
    const std::uint32_t expected = found == ranks.end() ? VoxelIndex::kNone : found->second;
    RC_ASSERT(index.rank(key, hint) == expected);
    RC_ASSERT(index.rank(key) == expected);
    asked.push_back(key);
    answers.push_back(expected);
  }
  std::vector<std::uint32_t> found(asked.size());
  index.ranks(asked, found);
  RC_ASSERT(found == answers);
  // Neighbours one after another, as scans have them, and none at all.
  found.assign(keys.size(), VoxelIndex::kNone);
  index.ranks(keys, found);
  for (std::size_t i = 0; i < keys.size(); ++i) RC_ASSERT(found[i] == i);
  index.ranks({}, {});
}

RC_GTEST_PROP(VoxelIndex, RanksAround_AreThoseOfTheNeighbours, ()) {
  const auto keys = in_z_order(test::any_cloud(1, 1500));
  const VoxelIndex index = index_of(keys);
  auto hint = *rc::gen::arbitrary<std::uint32_t>().as("hint");
  std::mt19937_64 random(keys.size());
  for (int i = 0; i < 300; ++i) {
    LatticePoint key = keys[random() % keys.size()];
    if (i % 3 == 0) key.z = test::clamp_to_int32(std::int64_t{key.z} + 1);  // Perhaps no voxel itself.
    std::array<std::uint32_t, 27> ranks;
    index.ranks_around(key, hint, ranks);
    for (int at = 0; at < 27; ++at) {
      const std::int64_t x = std::int64_t{key.x} + at / 9 - 1, y = std::int64_t{key.y} + at / 3 % 3 - 1,
                         z = std::int64_t{key.z} + at % 3 - 1;
      const LatticePoint p{test::clamp_to_int32(x), test::clamp_to_int32(y), test::clamp_to_int32(z)};
      const bool exists = p.x == x && p.y == y && p.z == z;
      RC_ASSERT(ranks[static_cast<std::size_t>(at)] == (exists ? index.rank(p) : VoxelIndex::kNone));
    }
  }
}

RC_GTEST_PROP(VoxelIndex, Blocks_AreThoseOfTheKeysInOrder, ()) {
  const auto keys = in_z_order(test::any_cloud(1, 2000));
  const VoxelIndex index = index_of(keys);
  std::uint32_t rank = 0;
  for (std::size_t i = 0; i < index.blocks(); ++i) {
    const VoxelIndex::Block block = index.block(i);
    RC_ASSERT(block.first_rank == rank);
    RC_ASSERT(block.voxels > 0U);
    for (std::uint32_t end = rank + block.voxels; rank < end; ++rank) {
      RC_ASSERT(block.key == (LatticePoint{keys[rank].x >> 3, keys[rank].y >> 3, keys[rank].z >> 3}));
    }
  }
  RC_ASSERT(rank == keys.size());
}

RC_GTEST_PROP(VoxelSelection, AnyBox_TakesTheBlocksThatMeetItAndNoOthers, ()) {
  const auto keys = in_z_order(test::any_cloud(1, 2000));
  const VoxelIndex index = index_of(keys);
  const LatticeBox box = any_box(keys);
  std::vector<BlockRange> expected;
  for (std::size_t i = 0; i < index.blocks(); ++i) {
    const VoxelIndex::Block block = index.block(i);
    LatticeBox cube;
    for (int axis = 0; axis < 3; ++axis) {
      cube.min[axis] = std::int64_t{block.key[axis]} * 8;
      cube.max[axis] = cube.min[axis] + 8;
    }
    LatticeBox seen = box;  // Blocks are judged by the part of the box where voxels can be.
    for (int axis = 0; axis < 3; ++axis) {
      seen.min[axis] = std::max(seen.min[axis], index.bounds().min[axis]);
      seen.max[axis] = std::min(seen.max[axis], index.bounds().max[axis]);
    }
    if (!cube.intersects(seen)) continue;
    if (!expected.empty() && expected.back().end == i) {
      expected.back().end = i + 1;
    } else {
      expected.push_back({i, i + 1});
    }
  }
  RC_ASSERT(select_blocks(index, box) == expected);
}

RC_GTEST_PROP(VoxelIndex, AnyRanks_HaveTheirKeys, ()) {
  const auto keys = in_z_order(test::any_cloud(1, 2000));
  const VoxelIndex index = index_of(keys);
  const auto size = static_cast<std::uint32_t>(keys.size());
  for (int i = 0; i < 10; ++i) {
    const auto begin = *rc::gen::inRange<std::uint32_t>(0, size + 1);
    const auto end = *rc::gen::inRange<std::uint32_t>(begin, size + 1);
    std::vector<LatticePoint> found;
    index.for_each_key(begin, end, [&](const LatticePoint& key) { found.push_back(key); });
    RC_ASSERT(found == std::vector<LatticePoint>(keys.begin() + begin, keys.begin() + end));
  }
}

RC_GTEST_PROP(VoxelIndex, AnySelection_IsAnIndexOfItsBlocks, ()) {
  const auto keys = in_z_order(test::any_cloud(1, 2000));
  const VoxelIndex index = index_of(keys);
  const auto ranges = select_blocks(index, any_box(keys));
  const VoxelIndex selection = index.selection(ranges);
  std::vector<LatticePoint> chosen;
  for (const BlockRange& range : ranges) {
    index.for_each_key(index.first_rank(range.begin), index.first_rank(range.end), [&](const LatticePoint& key) {
      RC_ASSERT(selection.rank(key) == chosen.size());
      RC_ASSERT(selection.bounds().contains(key));
      chosen.push_back(key);
    });
  }
  RC_ASSERT(selection.size() == chosen.size());
  for (const LatticePoint& key : keys) {
    const bool in = std::ranges::find(chosen, key) != chosen.end();
    RC_ASSERT(in == (selection.rank(key) != VoxelIndex::kNone));
  }
}

TEST(VoxelIndex, Empty_HasNoVoxel) {
  VoxelIndex index;
  index.finish();
  EXPECT_EQ(index.size(), 0U);
  EXPECT_TRUE(index.bounds().empty());
  EXPECT_EQ(index.rank({0, 0, 0}), VoxelIndex::kNone);
  const LatticePoint key{0, 0, 0};
  std::uint32_t rank = 7;
  index.ranks({&key, 1}, {&rank, 1});
  EXPECT_EQ(rank, VoxelIndex::kNone);
  EXPECT_EQ(index.blocks(), 0U);
  EXPECT_TRUE(select_blocks(index, {{-9, -9, -9}, {9, 9, 9}}).empty());
}

TEST(VoxelIndex, VoxelsAtTheEndsOfTheLattice_AreTold) {
  const auto keys = in_z_order({{kMin, kMin, kMin}, {kMax, kMax, kMax}, {kMin, kMax, 0}, {-1, 0, kMax}});
  const VoxelIndex index = index_of(keys);
  for (std::uint32_t i = 0; i < keys.size(); ++i) EXPECT_EQ(index.rank(keys[i]), i);
  EXPECT_EQ(index.rank({kMax, kMin, kMin}), VoxelIndex::kNone);
  EXPECT_EQ(select_blocks(index, index.bounds()), (std::vector<BlockRange>{{0, 4}}));
  const std::int64_t far = std::int64_t{1} << 40;
  EXPECT_EQ(select_blocks(index, {{-far, -far, -far}, {far, far, far}}), (std::vector<BlockRange>{{0, 4}}));
}

TEST(VoxelIndex, FullBlock_HasAllRanks) {
  std::vector<LatticePoint> keys;
  for (std::int32_t i = 0; i < 512; ++i) keys.push_back({(i >> 6) - 8, (i >> 3 & 7) + 8, (i & 7) - 16});
  keys = in_z_order(keys);
  const VoxelIndex index = index_of(keys);
  EXPECT_EQ(index.blocks(), 1U);
  for (std::uint32_t i = 0; i < keys.size(); ++i) EXPECT_EQ(index.rank(keys[i]), i);
}

TEST(VoxelIndex, PlaneOfVoxels_TakesLessThanThreeBytesEach) {
  const VoxelIndex index = index_of(in_z_order(test::plane_grid(400, 1, -200)));
  EXPECT_LT(index.memory_bytes(), 3 * index.size());
}

}  // namespace
}  // namespace arris::tiling
