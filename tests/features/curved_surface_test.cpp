#include "features/arris/curved_surface.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "ball_testing.h"

namespace arris {
namespace {

struct Explained {
  bool as_fold = false;
  FoldLine line;
  double curved_rms = 0.0;
};

Explained explain(const std::vector<Vector3>& cloud, double radius) {
  const BallPoints points = test::ball_of(cloud, radius);
  const PlanePair pair = fit_plane_pair(points, radius, fit_plane(sum_within(points, radius)));
  Explained result;
  result.as_fold = pair.kind == PlanePair::Kind::kArms && refine_fold(points, pair, result.line);
  if (result.as_fold) result.curved_rms = curved_surface_rms(points, result.line);
  return result;
}

TEST(CurvedSurface, Column_IsExplainedBetterThanByAFold) {
  for (const double radius : {6.0, 10.0, 20.0}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      std::vector<Vector3> cloud = test::column_points(radius, seed);
      test::rotate(test::any_rotation(seed), cloud);
      const Explained column = explain(cloud, 5.0);
      if (!column.as_fold) continue;
      EXPECT_LT(column.curved_rms, 0.93 * column.line.rms) << "radius " << radius << " seed " << seed;
    }
  }
}

TEST(CurvedSurface, Fold_IsNotExplained) {
  for (const double angle : {50.0, 90.0, 120.0, 140.0}) {
    for (const double noise : {0.0, 0.05}) {
      for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        std::vector<Vector3> cloud = test::fold_points(angle, seed);
        test::disturb(cloud, noise, seed);
        test::rotate(test::any_rotation(seed), cloud);
        const Explained fold = explain(cloud, 5.0);
        ASSERT_TRUE(fold.as_fold) << angle << " degrees, seed " << seed;
        EXPECT_GT(fold.curved_rms, 1.3 * fold.line.rms) << angle << " degrees, noise " << noise << " seed " << seed;
      }
    }
  }
}

TEST(CurvedSurface, ExactQuadric_LeavesNothing) {
  // w = 0.3 + 0.1 v - 0.05 v² + 0.2 t + 0.02 t² over the frame of a line along x that opens along z.
  std::vector<Vector3> cloud;
  for (int i = -16; i <= 16; ++i) {
    for (int j = -16; j <= 16; ++j) {
      const double t = 0.25 * i, v = -0.25 * j;  // v runs along direction x opening = -y.
      cloud.push_back({t, -v, 0.3 + 0.1 * v - 0.05 * v * v + 0.2 * t + 0.02 * t * t});
    }
  }
  FoldLine line;
  line.direction = {1, 0, 0};
  line.opening = {0, 0, 1};
  line.sine2_half = 1.0;
  EXPECT_LT(curved_surface_rms(test::ball_of(cloud), line), 1e-3);  // Of rounding.
}

TEST(CurvedSurface, PointsOnALine_DetermineNoSurface) {
  std::vector<Vector3> cloud;
  for (int i = -16; i <= 16; ++i) cloud.push_back({0.25 * i, 0.0, 0.0});
  EXPECT_TRUE(std::isinf(curved_surface_rms(test::ball_of(cloud), {})));
}

RC_GTEST_PROP(CurvedSurface, AnyOrder_GivesTheSameBits, (std::uint64_t seed)) {
  std::vector<Vector3> cloud = test::column_points(8.0, seed);
  test::disturb(cloud, 0.1, seed);
  FoldLine line;
  const test::Rotation axes = test::any_rotation(seed);
  line.direction = axes[0];
  line.opening = axes[1];
  line.sine2_half = 0.5;
  const double first = curved_surface_rms(test::ball_of(cloud, 9.0), line);
  test::shuffle(cloud, seed);
  RC_ASSERT(first == curved_surface_rms(test::ball_of(cloud, 9.0), line));
}

}  // namespace
}  // namespace arris
