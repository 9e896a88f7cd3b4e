#include "evaluate/truth_edge.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "random_edges.h"

namespace arris::evaluate {
namespace {

constexpr double kTiny = 1e-9;

TEST(TruthEdge_Segment, DistanceBesideBeforeAndBehind_IsAnalytic) {
  const TruthEdge edge = make_segment(EdgeKind::kConvex, "", {0, 0, 0}, {10, 0, 0}, 90.0);
  EXPECT_DOUBLE_EQ(edge.distance({4, 3, 4}), 5.0);
  EXPECT_DOUBLE_EQ(edge.distance({-3, 0, 4}), 5.0);
  EXPECT_DOUBLE_EQ(edge.distance({13, 4, 0}), 5.0);
  EXPECT_DOUBLE_EQ(edge.length(), 10.0);
}

TEST(TruthEdge_Circle, DistanceFromCentreAxisAndPlane_IsAnalytic) {
  const TruthEdge edge = make_circle(EdgeKind::kRimConvex, "", {1, 2, 3}, {0, 0, 2}, 5.0, 90.0);
  EXPECT_DOUBLE_EQ(edge.distance({1, 2, 3}), 5.0);
  EXPECT_DOUBLE_EQ(edge.distance({1, 2, 15}), 13.0);
  EXPECT_DOUBLE_EQ(edge.distance({9, 2, 7}), 5.0);
  EXPECT_DOUBLE_EQ(edge.length(), 10.0 * std::numbers::pi);
  EXPECT_TRUE(edge.closed());
}

TEST(TruthEdge_Arc, PointOutsideTheSweep_IsMeasuredToTheNearerEnd) {
  TruthEdge edge = make_circle(EdgeKind::kRimConvex, "", {0, 0, 0}, {0, 0, 1}, 1.0);
  edge.start = {1, 0, 0};
  edge.sweep_deg = 90.0;
  EXPECT_NEAR(edge.distance({1, -2, 0}), 2.0, kTiny);
  EXPECT_NEAR(edge.distance({-3, 1, 0}), 3.0, kTiny);
  EXPECT_NEAR(edge.distance({2 * std::sqrt(0.5), 2 * std::sqrt(0.5), 0}), 1.0, kTiny);
}

RC_GTEST_PROP(TruthEdge_Distance, AnyPoint_EqualsTheMinimumOverDenseSamples, ()) {
  const TruthEdge edge = *any_edge();
  const Vec3 point = *position();
  constexpr int kSamples = 2000;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSamples; ++i) least = std::min(least, norm(point - edge.point_at(i / double{kSamples})));
  const double distance = edge.distance(point);
  RC_ASSERT(distance <= least + kTiny);
  RC_ASSERT(distance >= least - edge.length() / kSamples - kTiny);
}

RC_GTEST_PROP(TruthEdge_Distance, PointOfTheEdge_IsZero, ()) {
  const TruthEdge edge = *any_edge();
  const double fraction = *rc::gen::inRange(0, 1001) / 1000.0;
  RC_ASSERT(edge.distance(edge.point_at(fraction)) < kTiny);
}

RC_GTEST_PROP(TruthEdge_Distance, MovedPoint_ChangesByNoMoreThanTheMove, ()) {
  const TruthEdge edge = *any_edge();
  const Vec3 p = *position(), q = *position();
  RC_ASSERT(std::abs(edge.distance(p) - edge.distance(q)) <= norm(p - q) + kTiny);
}

RC_GTEST_PROP(TruthEdge_PointAt, EqualFractions_AreEqualLengths, ()) {
  const TruthEdge edge = *any_edge();
  constexpr int kPieces = 4000;
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    sum += norm(edge.point_at((i + 1.0) / kPieces) - edge.point_at(i / double{kPieces}));
  }
  RC_ASSERT(std::abs(sum - edge.length()) <= 1e-5 * edge.length() + kTiny);
}

}  // namespace
}  // namespace arris::evaluate
