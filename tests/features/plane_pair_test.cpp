#include "features/arris/plane_pair.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>

#include "ball_testing.h"
#include "features/numerics/exact_math.h"

namespace arris {
namespace {

constexpr double kRadius = 5.0;

PlanePair pair_of(const std::vector<Vector3>& cloud, double radius = kRadius) {
  const BallPoints points = test::ball_of(cloud, radius);
  return fit_plane_pair(points, radius, fit_plane(sum_within(points, radius)));
}

/// Distance of p from the line in which the planes meet.
double distance_from_line(const PlanePair& pair, const Vector3& p) {
  // The nearest point of both planes, of p moved by normals only.
  const double c = dot(pair.a.normal, pair.b.normal);
  const double da = pair.a.distance(p[0], p[1], p[2]);
  const double db = pair.b.distance(p[0], p[1], p[2]);
  const double sine2 = 1.0 - c * c;
  return std::sqrt((da * da + db * db - 2.0 * c * da * db) / sine2);
}

class FoldAngles : public testing::TestWithParam<double> {};

TEST_P(FoldAngles, LineAndAngleAreThoseOfTheFold) {
  const double angle = GetParam();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Random random(seed);
    const double away = random.in(0.0, 1.5);  // The centre lies on one arm.
    const double half = 0.5 * angle / kDegreesPerRadian;
    const Vector3 centre{0.0, away * std::sin(half), away * std::cos(half)};
    std::vector<Vector3> cloud = test::moved(test::fold_points(angle, seed), {-centre[0], -centre[1], -centre[2]});
    const test::Rotation turn = test::any_rotation(seed);
    test::rotate(turn, cloud);
    const Vector3 on_line = test::rotated(turn, {-centre[0], -centre[1], -centre[2]});
    const Vector3 further = test::rotated(turn, {3.0 - centre[0], -centre[1], -centre[2]});
    const PlanePair pair = pair_of(cloud);
    ASSERT_EQ(pair.kind, PlanePair::Kind::kArms) << "seed " << seed;
    EXPECT_LT(pair.rms, 0.01) << "seed " << seed;
    EXPECT_LT(distance_from_line(pair, on_line), 0.05) << "seed " << seed;
    EXPECT_LT(distance_from_line(pair, further), 0.05) << "seed " << seed;
    const double between = arc_cosine(std::fabs(dot(pair.a.normal, pair.b.normal))) * kDegreesPerRadian;
    EXPECT_NEAR(between, std::min(angle, 180.0 - angle), 0.5) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, FoldAngles, testing::Values(40.0, 60.0, 80.0, 90.0, 100.0, 120.0, 140.0, 150.0));

TEST(PlanePair, ArmsAreOnTheirSidesOfTheSplit) {
  const PlanePair pair = pair_of(test::fold_points(90.0, 3));
  const auto side = [&](const FittedPlane& arm) { return dot(pair.split.g, arm.centroid) - pair.split.h; };
  EXPECT_GT(side(pair.a), 0.5);
  EXPECT_LT(side(pair.b), -0.5);
  EXPECT_NEAR(dot(pair.split.g, pair.split.g), 1.0, 1e-12);
}

TEST(PlanePair, TwoSheets_AreLayers) {
  for (const double gap : {2.0, 3.0, 4.0}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      std::vector<Vector3> cloud = test::layer_points(gap, seed);
      test::disturb(cloud, 0.05, seed);
      test::rotate(test::any_rotation(seed), cloud);
      const PlanePair pair = pair_of(cloud);
      ASSERT_EQ(pair.kind, PlanePair::Kind::kLayers) << "gap " << gap << " seed " << seed;
      const double apart = std::fabs(pair.a.distance(pair.b.centroid[0], pair.b.centroid[1], pair.b.centroid[2]));
      EXPECT_NEAR(apart, gap, 0.1);
      EXPECT_GT(std::fabs(dot(pair.a.normal, pair.b.normal)), 0.99);
    }
  }
}

RC_GTEST_PROP(PlanePair, AnyOrder_GivesTheSameBits, (std::uint64_t seed)) {
  const double noise = *rc::gen::element(0.0, 0.2, 0.8);
  const int kind = *rc::gen::inRange(0, 3);
  std::vector<Vector3> cloud = kind == 0   ? test::fold_points(*rc::gen::element(50.0, 90.0, 140.0), seed)
                               : kind == 1 ? test::layer_points(2.0, seed)
                                           : test::plane_points(seed);
  test::disturb(cloud, noise, seed);
  test::rotate(test::any_rotation(seed), cloud);
  const PlanePair first = pair_of(cloud, 9.0);
  test::shuffle(cloud, seed);
  const PlanePair second = pair_of(cloud, 9.0);
  RC_ASSERT(first.kind == second.kind);
  const auto values = [](const PlanePair& p) {
    std::vector<double> all{p.rms, p.split.h};
    for (const FittedPlane* plane : {&p.a, &p.b}) {
      for (const Vector3* v : {&plane->normal, &plane->centroid, &plane->e1})
        all.insert(all.end(), v->begin(), v->end());
      all.insert(all.end(), {plane->offset, plane->rms, plane->count});
    }
    return all;
  };
  RC_ASSERT(values(first) == values(second));
}

TEST(PlanePair, TooFewOrDegeneratePoints_AreNoPair) {
  const auto line = [](int points) {
    std::vector<Vector3> all;
    for (int i = 0; i < points; ++i) all.push_back({0.25 * i - 3.0, 0.5, 0.5});
    return all;
  };
  EXPECT_EQ(pair_of(std::vector<Vector3>(40, {0.0, 0.0, 0.0})).kind, PlanePair::Kind::kNone) << "coincident";
  std::vector<Vector3> few = test::fold_points(90.0, 1);
  std::erase_if(few, [](const Vector3& p) { return dot(p, p) > 2.4; });
  while (few.size() > 11) few.pop_back();
  EXPECT_EQ(pair_of(few).kind, PlanePair::Kind::kNone) << "fewer than twelve points";
  const PlanePair pair = pair_of(line(24));  // May be called arms of no width, but with finite numbers.
  EXPECT_TRUE(std::isfinite(pair.rms));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(std::isfinite(pair.a.normal[axis]));
    EXPECT_TRUE(std::isfinite(pair.b.normal[axis]));
  }
}

}  // namespace
}  // namespace arris
