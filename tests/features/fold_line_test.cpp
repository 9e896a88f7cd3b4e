#include "features/arris/fold_line.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "ball_testing.h"
#include "features/numerics/exact_math.h"

namespace arris {
namespace {

bool fold_in(const std::vector<Vector3>& cloud, double radius, FoldLine& line) {
  const BallPoints points = test::ball_of(cloud, radius);
  const PlanePair pair = fit_plane_pair(points, radius, fit_plane(sum_within(points, radius)));
  return pair.kind == PlanePair::Kind::kArms && refine_fold(points, pair, line);
}

std::vector<double> values(const FoldLine& l) {
  return {l.foot[0],
          l.foot[1],
          l.foot[2],
          l.direction[0],
          l.direction[1],
          l.direction[2],
          l.opening[0],
          l.opening[1],
          l.opening[2],
          l.distance,
          l.angle_deg,
          l.sine2_half,
          l.rms,
          l.count_a,
          l.count_b,
          l.position_error,
          static_cast<double>(l.support_a),
          static_cast<double>(l.support_b)};
}

class FoldLineAngles : public testing::TestWithParam<double> {};

TEST_P(FoldLineAngles, StraightFold_IsMeasured) {
  const double angle = GetParam();
  const double half = 0.5 * angle / kDegreesPerRadian;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Random random(seed);
    const double away = random.in(0.0, 1.0);
    const Vector3 back{0.0, -away * std::sin(half), -away * std::cos(half)};
    std::vector<Vector3> cloud = test::moved(test::fold_points(angle, seed), back);
    const test::Rotation turn = test::any_rotation(seed);
    test::rotate(turn, cloud);
    FoldLine line;
    ASSERT_TRUE(fold_in(cloud, 5.0, line)) << "seed " << seed;
    EXPECT_NEAR(line.angle_deg, angle, 0.5) << "seed " << seed;
    EXPECT_NEAR(line.distance, away, 0.03) << "seed " << seed;
    EXPECT_NEAR(line.sine2_half, std::sin(half) * std::sin(half), 0.01);
    EXPECT_GT(std::fabs(dot(line.direction, test::rotated(turn, {1, 0, 0}))), 0.9999);
    EXPECT_GT(dot(line.opening, test::rotated(turn, {0, 0, 1})), 0.999) << "the fold opens to the side of its arms";
    const Vector3 foot = test::rotated(turn, back);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(line.foot[axis], foot[axis], 0.03) << "seed " << seed;
    EXPECT_LT(line.rms, 0.01);
    EXPECT_GE(line.support_a, 1);
    EXPECT_GE(line.support_b, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, FoldLineAngles, testing::Values(40.0, 60.0, 90.0, 120.0, 140.0, 150.0));

TEST(FoldLine, PositionError_IsWhatNoiseDoesToTheLine) {
  double squares = 0.0;
  double predicted = 0.0;
  constexpr int kRuns = 200;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::vector<Vector3> cloud = test::fold_points(90.0, seed);
    test::disturb(cloud, 0.1, seed);
    FoldLine line;
    ASSERT_TRUE(fold_in(cloud, 5.0, line));
    squares += line.distance * line.distance;
    predicted += line.position_error * line.position_error;
  }
  const double ratio = std::sqrt(squares / predicted);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2.0);
}

class CurvedRim : public testing::TestWithParam<double> {};

TEST_P(CurvedRim, LineIsWithinATenthOfTheSpacing) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double inside = test::Random(seed).in(0.0, 0.9);  // The centre lies on the cap.
    const std::vector<Vector3> cloud = test::moved(test::rim_points(GetParam(), seed), {0.0, inside, 0.0});
    FoldLine line;
    ASSERT_TRUE(fold_in(cloud, 5.0, line)) << "seed " << seed;
    EXPECT_NEAR(line.foot[1], inside, 0.1) << "seed " << seed;
    EXPECT_NEAR(line.foot[2], 0.0, 0.1) << "seed " << seed;
    EXPECT_NEAR(line.angle_deg, 90.0, 3.0) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Radii, CurvedRim, testing::Values(15.0, 28.0, 60.0));

RC_GTEST_PROP(FoldLine, AnyOrder_GivesTheSameBits, (std::uint64_t seed)) {
  std::vector<Vector3> cloud = *rc::gen::arbitrary<bool>()
                                   ? test::rim_points(20.0, seed)
                                   : test::fold_points(*rc::gen::element(50.0, 90.0, 130.0), seed);
  test::disturb(cloud, *rc::gen::element(0.0, 0.2, 0.8), seed);
  test::rotate(test::any_rotation(seed), cloud);
  FoldLine first, second;
  const bool found = fold_in(cloud, 9.0, first);
  test::shuffle(cloud, seed);
  RC_ASSERT(found == fold_in(cloud, 9.0, second));
  RC_ASSERT(values(first) == values(second));
}

TEST(FoldLine, DegeneratePoints_AreRefusedOrFinite) {
  PlanePair pair;  // A right angle, whatever the points.
  pair.kind = PlanePair::Kind::kArms;
  pair.a.normal = {0, 0, 1};
  pair.a.centroid = {0, 2, 0};
  pair.b.normal = {0, 1, 0};
  pair.b.centroid = {0, 0, 2};
  FoldLine line;
  EXPECT_FALSE(refine_fold(test::ball_of(std::vector<Vector3>(100, {0, 0, 0})), pair, line)) << "coincident";
  EXPECT_FALSE(refine_fold(test::ball_of({{0, 1, 0}, {0, 2, 0}, {0, 0, 1}}), pair, line)) << "three points";
  std::vector<Vector3> lines;
  for (int i = 1; i < 40; ++i) {
    lines.push_back({0.0, 0.1 * i, 0.0});
    lines.push_back({0.0, 0.0, 0.1 * i});
  }
  EXPECT_FALSE(refine_fold(test::ball_of(lines), pair, line)) << "no width along the line";
  pair.b = pair.a;
  EXPECT_FALSE(refine_fold(test::ball_of(test::plane_points(1)), pair, line)) << "parallel planes";
}

}  // namespace
}  // namespace arris
