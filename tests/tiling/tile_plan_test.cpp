#include "tiling/tile_plan.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

#include "core/error.h"
#include "tiling/random_cloud.h"
#include "tiling/spacing.h"
#include "tiling/survey_of.h"

namespace arris::tiling {
namespace {

using test::survey_of;

PlanRequest request(std::uint64_t max_points, double halo_factor = 3.0, double max_radius = 1e9) {
  PlanRequest request;
  request.max_points = max_points;
  request.halo = [halo_factor](double spacing) { return halo_factor * spacing; };
  request.max_radius = max_radius;
  return request;
}

std::uint64_t count_inside(const std::vector<LatticePoint>& points, const LatticeBox& box) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(points, [&](const LatticePoint& p) { return box.contains(p); }));
}

RC_GTEST_PROP(TilePlan, AnyCloud_CoresOwnEveryPointOnceAndCountsHold, ()) {
  const auto points = test::any_cloud(1, 800);
  const Survey survey = survey_of(points, *rc::gen::inRange<std::size_t>(1, 200).as("max leaves"));
  const auto cap = *rc::gen::inRange<std::uint64_t>(1, 400).as("max points");
  const TilePlan plan = plan_tiles(survey, request(cap, 0.5));
  const int level = survey.counts.level();
  std::uint64_t owned = 0, covered = 0, largest = 0;
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const PlannedTile& tile = plan.tiles[i];
    RC_ASSERT(tile.core_points == count_inside(points, tile.core));
    RC_ASSERT(tile.core_points > 0U);
    RC_ASSERT(tile.covered_points >= count_inside(points, tile.covered));
    for (std::size_t other = 0; other < i; ++other) RC_ASSERT(!tile.core.intersects(plan.tiles[other].core));
    bool one_cell = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      RC_ASSERT(tile.core.min[axis] % (std::int64_t{1} << level) == 0);
      RC_ASSERT(tile.core.max[axis] % (std::int64_t{1} << level) == 0);
      RC_ASSERT(tile.covered.min[axis] < tile.core.min[axis]);
      RC_ASSERT(tile.covered.max[axis] > tile.core.max[axis]);
      one_cell = one_cell && tile.core.max[axis] - tile.core.min[axis] == std::int64_t{1} << level;
    }
    RC_ASSERT(tile.covered_points <= cap || one_cell);
    owned += tile.core_points;
    covered += tile.covered_points;
    largest = std::max(largest, tile.covered_points);
  }
  RC_ASSERT(owned == points.size());  // With disjoint cores: every point has exactly one owner.
  RC_ASSERT(plan.largest_covered_points == largest);
  RC_ASSERT(plan.duplication == static_cast<double>(covered) / static_cast<double>(points.size()));
}

TEST(TilePlan, PointsOnCutsEdgesAndCorners_HaveOneOwner) {
  // A cube of points on all multiples of 16: many lie on faces, edges and corners of cores.
  std::vector<LatticePoint> points;
  for (int x = -64; x <= 64; x += 16) {
    for (int y = -64; y <= 64; y += 16) {
      for (int z = -64; z <= 64; z += 16) points.push_back({x, y, z});
    }
  }
  const TilePlan plan = plan_tiles(survey_of(points, 8), request(200, 0.1));
  ASSERT_GT(plan.tiles.size(), 4U);
  for (const LatticePoint& p : points) {
    EXPECT_EQ(std::ranges::count_if(plan.tiles, [&](const PlannedTile& tile) { return tile.core.contains(p); }), 1);
  }
}

TEST(TilePlan, Cores_StayWithinOneOctreeCellPerSplit) {
  // Every pair of tiles is separated by a plane at a multiple of a power of two at least as large as the smaller tile.
  const auto points = test::plane_grid(200, 10, -700);
  const TilePlan plan = plan_tiles(survey_of(points), request(6000));
  ASSERT_GT(plan.tiles.size(), 8U);
  for (const PlannedTile& tile : plan.tiles) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto size = static_cast<std::uint64_t>(tile.core.max[axis] - tile.core.min[axis]);
      const auto block = static_cast<std::int64_t>(std::bit_ceil(size));
      const auto floor_block = [&](std::int64_t v) { return v >= 0 ? v / block : -((-v + block - 1) / block); };
      const std::int64_t blocks = floor_block(tile.core.max[axis] - 1) - floor_block(tile.core.min[axis]);
      EXPECT_LE(blocks, 1) << "a core spans more octree cells of its size than a split allows";
    }
  }
}

TEST(TilePlan, EverythingFits_IsOneTile) {
  const auto points = test::plane_grid(50, 10);
  const TilePlan plan = plan_tiles(survey_of(points), request(2500));
  ASSERT_EQ(plan.tiles.size(), 1U);
  EXPECT_EQ(plan.tiles[0].core_points, 2500U);
  EXPECT_EQ(plan.tiles[0].covered_points, 2500U);
  EXPECT_DOUBLE_EQ(plan.duplication, 1.0);
}

TEST(TilePlan, Halo_FollowsTheSpacingOfTheTile) {
  // Dense on the left, sparse on the right, far apart.
  std::vector<LatticePoint> points = test::plane_grid(200, 10);
  for (const LatticePoint& p : test::plane_grid(200, 100, 1'000'000)) points.push_back(p);
  const TilePlan plan = plan_tiles(survey_of(points), request(45'000, 4.0));
  ASSERT_EQ(plan.tiles.size(), 2U);
  const auto halo = [](const PlannedTile& tile) { return static_cast<double>(tile.core.min[0] - tile.covered.min[0]); };
  // The 95th percentile sees cells that the rim cuts, so it may exceed the grid's spacing somewhat.
  EXPECT_GE(halo(plan.tiles[0]), 4.0 * 10 * 0.9);
  EXPECT_LE(halo(plan.tiles[0]), 4.0 * 10 * 2.0);
  EXPECT_GE(halo(plan.tiles[1]), 4.0 * 100 * 0.9);
  EXPECT_LE(halo(plan.tiles[1]), 4.0 * 100 * 2.0);
}

TEST(TilePlan, Halo_IsCappedAndAtLeastAStep) {
  const auto points = test::plane_grid(100, 10);
  const Survey survey = survey_of(points);
  const auto halo = [&](const PlanRequest& asked) {
    const TilePlan plan = plan_tiles(survey, asked);
    return plan.tiles[0].core.min[0] - plan.tiles[0].covered.min[0];
  };
  EXPECT_EQ(halo(request(1'000'000, 1000.0, 7.4)), 15);  // ceil(7.4 / 0.5)
  EXPECT_EQ(halo(request(1'000'000, 0.0)), 1);
}

TEST(TilePlan, SmallCloudOnAFineLattice_HaloFollowsTheSpacingNotTheCell) {
  // 900 points 500 steps apart stay on level 0, where every cell holds one point.
  const auto points = test::plane_grid(30, 500);
  const Survey survey = survey_of(points);
  ASSERT_EQ(survey.counts.level(), 0);
  const TilePlan plan = plan_tiles(survey, request(10'000, 1.0));
  const std::int64_t halo = plan.tiles[0].core.min[0] - plan.tiles[0].covered.min[0];
  EXPECT_GE(halo, 400);
  EXPECT_LE(halo, 2000);
}

TEST(TilePlan, MaxCorePoints_CapsCoresToo) {
  PlanRequest asked = request(1'000'000);
  asked.max_core_points = 700;
  const TilePlan plan = plan_tiles(survey_of(test::plane_grid(100, 10)), asked);
  ASSERT_GT(plan.tiles.size(), 10U);
  for (const PlannedTile& tile : plan.tiles) EXPECT_LE(tile.core_points, 700U);
}

TEST(TilePlan, HaloThatHoldsMoreThanATile_IsNarrowedRatherThanCutForever) {
  // A halo of 100 spacings on each side holds 40 000 points, the tile 1000.
  const TilePlan plan = plan_tiles(survey_of(test::plane_grid(200, 10)), request(1000, 200.0));
  EXPECT_LE(plan.largest_covered_points, 1000U);
  EXPECT_LE(plan.tiles.size(), 1000U);
}

RC_GTEST_PROP(TilePlan, WholeHalo_IsNeverNarrowed, ()) {
  const auto points = test::any_cloud(1, 800);
  PlanRequest asked = request(*rc::gen::inRange<std::uint64_t>(1, 400).as("max points"));
  const auto halo_steps = *rc::gen::inRange<std::int64_t>(1, 5'000'000).as("halo");
  asked.halo = [&](double) { return 0.5 * static_cast<double>(halo_steps); };  // A step is 0.5.
  asked.whole_halo = true;
  const TilePlan plan = plan_tiles(survey_of(points), asked);
  std::uint64_t owned = 0;
  for (const PlannedTile& tile : plan.tiles) {
    RC_ASSERT(tile.covered == tile.core.expanded(halo_steps));
    owned += count_inside(points, tile.core);
  }
  RC_ASSERT(owned == points.size());
}

TEST(TilePlan, WholeHaloThatHoldsMoreThanATile_IsReportedNotCutForever) {
  PlanRequest asked = request(1000, 200.0);
  asked.whole_halo = true;
  const TilePlan plan = plan_tiles(survey_of(test::plane_grid(200, 10)), asked);
  EXPECT_GT(plan.largest_covered_points, 1000U) << "the caller must learn that the budget cannot be met";
  // Cutting ends below 1000 / 64 points a core.
  EXPECT_LE(plan.tiles.size(), 64U * 200 * 200 / 1000 * 4);
}

TEST(TilePlan, OverfullCell_IsReportedNotCut) {
  const std::vector<LatticePoint> points(1000, LatticePoint{5, 5, 5});
  const TilePlan plan = plan_tiles(survey_of(points), request(10));
  ASSERT_EQ(plan.tiles.size(), 1U);
  EXPECT_EQ(plan.largest_covered_points, 1000U);
}

TEST(TilePlan, NoPoints_IsNoTiles) {
  const TilePlan plan = plan_tiles(survey_of({}), request(10));
  EXPECT_TRUE(plan.tiles.empty());
  EXPECT_DOUBLE_EQ(plan.duplication, 1.0);
}

TEST(TilePlan, BadRequest_IsRefused) {
  const Survey survey = survey_of({{0, 0, 0}});
  EXPECT_THROW(plan_tiles(survey, request(0)), ConfigError);
  EXPECT_THROW(plan_tiles(survey, request(10, 1.0, 0.0)), ConfigError);
}

}  // namespace
}  // namespace arris::tiling
