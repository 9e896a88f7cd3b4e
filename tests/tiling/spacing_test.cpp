#include "tiling/spacing.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tiling/random_cloud.h"

namespace arris::tiling {
namespace {

SpacingEstimate estimate(const std::vector<LatticePoint>& points, std::size_t max_leaves = 8192) {
  CellCounts counts(0, max_leaves);
  counts.add(points);
  LatticeBox bounds;
  for (const LatticePoint& p : points) bounds.include(p);
  return estimate_spacing(counts, counts.classes(), bounds);
}

class SpacingOfGrid : public testing::TestWithParam<std::int32_t> {};

TEST_P(SpacingOfGrid, IsTheGridStep) {
  const std::int32_t step = GetParam();
  // Cells of a power of two hold a varying number of grid points: within a fifth for a step that divides nothing.
  EXPECT_NEAR(estimate(test::plane_grid(300, step)).steps, step, 0.2 * step);
  EXPECT_NEAR(estimate(test::plane_grid(300, step, -150 * step)).steps, step, 0.2 * step);
}
INSTANTIATE_TEST_SUITE_P(Steps, SpacingOfGrid, testing::Values(2, 7, 10, 64, 100, 999, 5000));

TEST(Spacing, RandomPlane_IsOneOverTheRootOfDensity) {
  std::mt19937_64 random(7);
  std::vector<LatticePoint> points;
  constexpr std::uint64_t kSide = 1'000'000;
  for (int i = 0; i < 100'000; ++i) {
    points.push_back({static_cast<std::int32_t>(random() % kSide), static_cast<std::int32_t>(random() % kSide), -50});
  }
  const double expected = static_cast<double>(kSide) / std::sqrt(100'000.0);
  EXPECT_NEAR(estimate(points).steps, expected, 0.15 * expected);
}

TEST(Spacing, CoarseSurvey_StillMeasuresFromCounts) {
  // 64 leaves hold a 300 x 300 grid only in large cells.
  EXPECT_NEAR(estimate(test::plane_grid(300, 100), 64).steps, 100.0, 20.0);
}

TEST(Spacing, MostPointsDense_FollowsThePointsNotTheArea) {
  std::vector<LatticePoint> points = test::plane_grid(200, 10);
  for (const LatticePoint& p : test::plane_grid(100, 2000, 1'000'000)) points.push_back(p);
  EXPECT_NEAR(estimate(points).steps, 10.0, 2.0);
}

TEST(Spacing, NoPoints_IsZero) {
  EXPECT_EQ(estimate({}).steps, 0.0);
}

TEST(Spacing, OnlyDuplicates_IsOneStep) {
  EXPECT_EQ(estimate(std::vector<LatticePoint>(5000, LatticePoint{3, 4, 5})).steps, 1.0);
  EXPECT_EQ(estimate({{3, 4, 5}}).steps, 1.0);
}

TEST(Spacing, HandfulOfPoints_FollowsTheExtent) {
  const auto few = estimate({{-1000, -1000, -1}, {1000, -1000, 0}, {-1000, 1000, 0}, {1000, 1000, 0}});
  EXPECT_EQ(few.level, -1);
  EXPECT_DOUBLE_EQ(few.steps, 2001.0 / 2.0);
}

RC_GTEST_PROP(Spacing, AnyOrder_IsTheSameToTheBit, ()) {
  auto points = test::any_cloud(1, 500);
  const auto max_leaves = *rc::gen::inRange<std::size_t>(1, 100);
  const double one = estimate(points, max_leaves).steps;
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::ranges::shuffle(points, random);
  RC_ASSERT(one == estimate(points, max_leaves).steps);
  RC_ASSERT(one >= 1.0);
}

}  // namespace
}  // namespace arris::tiling
