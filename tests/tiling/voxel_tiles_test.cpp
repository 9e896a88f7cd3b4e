#include "tiling/voxel_tiles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "support/temp_folder.h"
#include "tiling/random_cloud.h"
#include "tiling/voxel_accumulator.h"
#include "tiling/voxel_oracle.h"

namespace arris::tiling {
namespace {

constexpr std::uint64_t kHaloIsTooLarge = 64;  // Below this share of what fits a core is not cut for its halo.

/// Points so near each other that most voxels have neighbours.
std::vector<LatticePoint> any_surface(std::int32_t side) {
  std::vector<LatticePoint> points = test::any_cloud(1, 300);
  std::mt19937_64 random(points.size());
  const LatticePoint middle = points[0];
  const auto near = [&](std::int32_t v, std::int64_t voxels) {
    const auto range = static_cast<std::uint64_t>(voxels * side);
    return test::clamp_to_int32(v + static_cast<std::int64_t>(random() % range) - voxels * side / 2);
  };
  for (int i = 0; i < 4000; ++i) points.push_back({near(middle.x, 60), near(middle.y, 60), near(middle.z, 3)});
  return points;
}

std::vector<RawColour> colours_of(const std::vector<LatticePoint>& points) {
  std::vector<RawColour> colours;
  for (const LatticePoint& p : points)
    colours.push_back(
        {static_cast<std::uint16_t>(p.x), static_cast<std::uint16_t>(p.y), static_cast<std::uint16_t>(p.z)});
  return colours;
}

VoxelStore store_of(std::int32_t side, const std::vector<LatticePoint>& points, const std::filesystem::path& folder) {
  VoxelAccumulator accumulator(VoxelGrid(side), {folder, 1 << 20});
  accumulator.add(points, colours_of(points));
  return accumulator.finish();
}

std::uint64_t count_inside(const std::vector<Voxel>& voxels, const LatticeBox& box) {
  return static_cast<std::uint64_t>(std::ranges::count_if(voxels, [&](const Voxel& v) { return box.contains(v.key); }));
}

bool one_block(const LatticeBox& box) {
  return box.max[0] - box.min[0] <= 8 && box.max[1] - box.min[1] <= 8 && box.max[2] - box.min[2] <= 8;
}

/// The smallest box of whole blocks around a box.
LatticeBox in_blocks(LatticeBox box) {
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = 8 * test::floor_divided(box.min[axis], 8);
    box.max[axis] = -8 * test::floor_divided(-box.max[axis], 8);
  }
  return box;
}

RC_GTEST_PROP(VoxelTiles, AnyPlan_OwnsEveryVoxelOnceAndKeepsTheCaps, ()) {
  const std::int32_t side = *rc::gen::inRange(1, 40).as("side");
  const auto points = any_surface(side);
  const auto voxels = test::voxels_of(side, points, {});
  const test::TempFolder folder;
  const VoxelStore store = store_of(side, points, folder.path());
  VoxelPlanRequest request;
  request.max_voxels = *rc::gen::inRange<std::uint64_t>(1, 4000).as("max voxels");
  request.max_core_voxels = *rc::gen::inRange<std::uint64_t>(0, 2000).as("max core voxels");
  request.halo_voxels = *rc::gen::inRange(0, 30).as("halo");
  const TilePlan plan = plan_voxel_tiles(store.index(), request);
  std::uint64_t owned = 0;
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const PlannedTile& tile = plan.tiles[i];
    RC_ASSERT(tile.core_points == count_inside(voxels, tile.core));
    RC_ASSERT(tile.core_points > 0U);
    RC_ASSERT(tile.covered_points >= count_inside(voxels, tile.covered));
    RC_ASSERT(tile.covered == in_blocks(tile.core.expanded(std::max(1, request.halo_voxels))));
    for (std::size_t other = 0; other < i; ++other) RC_ASSERT(!tile.core.intersects(plan.tiles[other].core));
    RC_ASSERT(tile.covered_points <= request.max_voxels || one_block(tile.core) ||
              tile.core_points <= request.max_voxels / kHaloIsTooLarge);
    RC_ASSERT(request.max_core_voxels == 0 || tile.core_points <= request.max_core_voxels || one_block(tile.core));
    owned += tile.core_points;
  }
  RC_ASSERT(owned == voxels.size());
}

TEST(VoxelTiles, EverythingFits_IsOneTile) {
  const test::TempFolder folder;
  const auto points = test::plane_grid(100, 3);
  const VoxelStore store = store_of(3, points, folder.path());
  const TilePlan plan = plan_voxel_tiles(store.index(), {10'000, 0, 20});
  ASSERT_EQ(plan.tiles.size(), 1U);
  EXPECT_EQ(plan.tiles[0].core_points, 10'000U);
  EXPECT_EQ(plan_voxel_tiles(store.index(), {10'000, 9'999, 20}).tiles.size(), 2U);
}

/// By the definition of a tile: what is in the box, with positions in fractions modulo 2^32.
void expect_tile(const VoxelTile& tile, const std::vector<Voxel>& all, const PlannedTile& planned, std::int32_t side,
                 bool colours) {
  std::map<LatticePoint, std::uint32_t> at;
  std::size_t i = 0;
  for (std::uint32_t rank = 0; rank < all.size(); ++rank) {
    const Voxel& voxel = all[rank];
    if (!planned.covered.contains(voxel.key)) continue;
    RC_ASSERT(i < tile.size());
    RC_ASSERT(tile.keys[i] == voxel.key);
    RC_ASSERT(tile.ranks[i] == rank);
    RC_ASSERT((tile.core[i] != 0) == planned.core.contains(voxel.key));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t fractions =
          kVoxelFractions * test::voxel_corner(voxel.key[static_cast<int>(axis)], side) + voxel.centroid[axis];
      RC_ASSERT(tile.positions[i][axis] == static_cast<std::uint32_t>(static_cast<std::uint64_t>(fractions)));
    }
    if (colours) RC_ASSERT(tile.colours[i] == voxel.colour);
    at[voxel.key] = static_cast<std::uint32_t>(i++);
  }
  RC_ASSERT(i == tile.size());
  RC_ASSERT(tile.colours.size() == (colours ? tile.size() : 0U));
  for (std::size_t v = 0; v < tile.size(); ++v) {
    std::vector<std::uint32_t> expected;
    for (int n = 0; n < 27; ++n) {
      const std::int64_t x = std::int64_t{tile.keys[v].x} + n / 9 - 1, y = std::int64_t{tile.keys[v].y} + n / 3 % 3 - 1,
                         z = std::int64_t{tile.keys[v].z} + n % 3 - 1;
      const LatticePoint key{test::clamp_to_int32(x), test::clamp_to_int32(y), test::clamp_to_int32(z)};
      if (n == 13 || key.x != x || key.y != y || key.z != z) continue;
      if (const auto found = at.find(key); found != at.end()) expected.push_back(found->second);
    }
    const auto found = tile.neighbours_of(v);
    RC_ASSERT(std::vector<std::uint32_t>(found.begin(), found.end()) == expected);
  }
}

RC_GTEST_PROP(VoxelTiles, AnyTile_LoadsWhatItsBoxHoldsWithTheNeighboursInside, ()) {
  const auto side = *rc::gen::oneOf(rc::gen::inRange(1, 40), rc::gen::inRange(1, kMostVoxelSide)).as("side");
  const auto points = any_surface(side);
  const auto all = test::voxels_of(side, points, colours_of(points));
  const test::TempFolder folder;
  const VoxelStore store = store_of(side, points, folder.path());
  const auto cap = *rc::gen::inRange<std::uint64_t>(1, all.size() + 2).as("max core voxels");
  const TilePlan plan = plan_voxel_tiles(store.index(), {1'000'000, cap, *rc::gen::inRange(0, 12).as("halo")});
  const auto colours = *rc::gen::arbitrary<bool>().as("colours");
  for (const PlannedTile& planned : plan.tiles) {
    LinkBegins begins;
    expect_tile(load_voxel_tile(store, planned, colours, begins), all, planned, side, colours);
    expect_tile(load_voxel_tile(store, planned, colours, begins), all, planned, side, colours);  // Without counting.
  }
}

TEST(VoxelTiles, PositionsBeyond32BitsOfFractions_KeepTheirDifferences) {
  // 2^28 steps are 2^32 fractions: positions wrap around between the two voxels.
  const std::int32_t border = 1 << 28;
  const test::TempFolder folder;
  const VoxelStore store = store_of(10, {{border - 9, -border - 9, 7}, {border + 12, -border + 12, 7}}, folder.path());
  const TilePlan plan = plan_voxel_tiles(store.index(), {10, 0, 5});
  ASSERT_EQ(plan.tiles.size(), 1U);
  LinkBegins begins;
  const VoxelTile tile = load_voxel_tile(store, plan.tiles[0], false, begins);
  ASSERT_EQ(tile.size(), 2U);
  const std::size_t left = tile.keys[0].x < tile.keys[1].x ? 0 : 1;
  for (const std::size_t axis : {0U, 1U}) {
    EXPECT_EQ(difference(tile.positions[1 - left][axis], tile.positions[left][axis]), 21 * kVoxelFractions);
    EXPECT_EQ(difference(tile.positions[left][axis], tile.positions[1 - left][axis]), -21 * kVoxelFractions);
  }
  EXPECT_EQ(difference(tile.positions[0][2], tile.positions[1][2]), 0);
}

}  // namespace
}  // namespace arris::tiling
