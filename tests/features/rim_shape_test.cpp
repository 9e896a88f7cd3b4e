#include "features/arris/rim_shape.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ball_testing.h"
#include "features/numerics/exact_math.h"

namespace arris {
namespace {

constexpr double kRadius = 5.0;
/// Smaller gaps are no rim: nothing else is measured.
constexpr double kLeastGap_deg = 105.0;

RimShape rim_of(const std::vector<Vector3>& cloud, double noise = 0.0, double radius = kRadius) {
  RimScratch scratch;
  return measure_rim(test::ball_of(cloud, radius), radius, noise, scratch);
}

/// The points of a surface that `keep` keeps, moved so that the kept point nearest to `wanted` is the centre.
template <class Keep>
std::vector<Vector3> around(std::vector<Vector3> points, const Vector3& wanted, Keep&& keep) {
  std::erase_if(points, [&](const Vector3& p) { return !keep(p); });
  Vector3 best{1e9, 0, 0};
  const auto distance2 = [&](const Vector3& p) {
    const Vector3 d{p[0] - wanted[0], p[1] - wanted[1], p[2] - wanted[2]};
    return dot(d, d);
  };
  for (const Vector3& p : points) {
    if (distance2(p) < distance2(best)) best = p;
  }
  return test::moved(std::move(points), {-best[0], -best[1], -best[2]});
}

TEST(RimShape, Interior_IsSurrounded) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Vector3> cloud = around(test::plane_points(seed), {0, 0, 0}, [](const Vector3&) { return true; });
    test::rotate(test::any_rotation(seed), cloud);
    const RimShape rim = rim_of(cloud);
    EXPECT_LT(rim.gap_deg, 60.0);
    EXPECT_LT(rim.rms, 0.01);
    EXPECT_LT(rim.offset, 0.01);
    EXPECT_GT(rim.width, 2.0);
    EXPECT_GT(rim.inner_share, 0.99);
  }
}

TEST(RimShape, HalfPlane_HasItsBorderAtTheRightDepth) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double deep : {0.5, 1.5, 2.5}) {  // Row of the centre, from the border y < 0.
      std::vector<Vector3> cloud =
          around(test::plane_points(seed), {0, -deep, 0}, [](const Vector3& p) { return p[1] < 0.0; });
      const Vector3 outwards = test::rotated(test::any_rotation(seed), {0, 1, 0});
      test::rotate(test::any_rotation(seed), cloud);
      const RimShape rim = rim_of(cloud);
      const double rows = deep - 0.5;  // Between the centre's row and the last one; each is off by 0.25 at most.
      if (rows < 1.0) {
        EXPECT_GT(rim.gap_deg, 130.0);
        EXPECT_LT(rim.gap_deg, 230.0);
        EXPECT_GT(rim.empty_radius, 1.8);
      }
      if (rows > 1.0) {
        EXPECT_LT(rim.gap_deg, 150.0);
      }
      if (rim.gap_deg < kLeastGap_deg) continue;
      EXPECT_NEAR(rim.depth, rows, 0.55) << "seed " << seed;
      EXPECT_NEAR(std::sqrt(dot(rim.nearest, rim.nearest)), rim.depth, 0.02) << "the way to the rim is as long as deep";
      if (rim.depth > 0.3) {
        EXPECT_GT(dot(rim.nearest, outwards), 0.8 * rim.depth) << "and leads there";
      }
      if (rows < 1.0) {
        EXPECT_LT(std::fabs(dot(rim.direction, outwards)), 0.6) << "the rim runs along";
      }
    }
  }
}

TEST(RimShape, Corner_HasAGapOfThreeQuarters) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Vector3> cloud =
        around(test::plane_points(seed), {0, 0, 0}, [](const Vector3& p) { return p[0] < 0.0 && p[1] < 0.0; });
    test::rotate(test::any_rotation(seed), cloud);
    const RimShape rim = rim_of(cloud);
    EXPECT_GT(rim.gap_deg, 225.0);
    EXPECT_LT(rim.gap_deg, 315.0);
    EXPECT_LT(rim.depth, 0.3);
  }
}

TEST(RimShape, Hole_LeavesADiscOfItsSizeEmpty) {
  for (const double hole : {6.0, 10.0}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      std::vector<Vector3> cloud = test::plane_points(seed);
      std::erase_if(cloud, [&](const Vector3& p) {
        return std::hypot(p[0], p[1]) < hole || std::hypot(p[0] - hole, p[1]) < 0.5;
      });
      cloud.push_back({hole, 0.0, 0.0});  // On the very rim.
      cloud = test::moved(cloud, {-hole, 0.0, 0.0});
      test::rotate(test::any_rotation(seed), cloud);
      const RimShape rim = rim_of(cloud);
      EXPECT_GT(rim.gap_deg, kLeastGap_deg) << "hole " << hole << " seed " << seed;
      EXPECT_GT(rim.empty_radius, hole - 0.05) << "hole " << hole << " seed " << seed;
      EXPECT_LT(rim.empty_radius, 2.5 * hole) << "hole " << hole << " seed " << seed;
    }
  }
}

TEST(RimShape, SecondLayer_DoesNotFillTheGap) {
  for (const double gap : {2.0, 3.0, 4.0}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      std::vector<Vector3> cloud = around(test::layer_points(gap, seed), {0, -0.5, 0},
                                          [](const Vector3& p) { return p[2] > 1.0 || p[1] < 0.0; });
      test::disturb(cloud, 0.05, seed);
      test::rotate(test::any_rotation(seed), cloud);
      const RimShape rim = rim_of(cloud, 0.05);
      EXPECT_GT(rim.gap_deg, 120.0) << "gap " << gap << " seed " << seed;
      EXPECT_LT(rim.depth, 0.8) << "gap " << gap << " seed " << seed;
      EXPECT_LT(rim.rms, 0.3) << "gap " << gap << " seed " << seed;
    }
  }
}

TEST(RimShape, BothLayers_InteriorIsSurrounded) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Vector3> cloud = around(test::layer_points(2.0, seed), {0, 0, 0}, [](const Vector3&) { return true; });
    test::rotate(test::any_rotation(seed), cloud);
    const RimShape rim = rim_of(cloud);
    EXPECT_LT(rim.gap_deg, 60.0) << "seed " << seed;
    EXPECT_LT(rim.rms, 0.1) << "seed " << seed;
  }
}

/// Flat clouds with holes and bays of any kind, the centre among the points.
std::vector<Vector3> any_flat_cloud(std::uint64_t seed) {
  test::Random random(seed);
  const double cut = random.in(-3.0, 6.0);
  const double hole = random.in(0.0, 4.0);
  const double hx = random.in(-5.0, 5.0), hy = random.in(-5.0, 5.0);
  // The first ones, on one side, are enough to tell where the plane is.
  std::vector<Vector3> cloud{{0.0, 0.0, 0.0}, {1.0, 0.1, 0.0}, {1.2, 0.7, 0.0}, {1.6, 0.2, 0.0}, {0.7, 0.5, 0.0}};
  while (cloud.size() < 90) {
    const Vector3 p{random.in(-5.0, 5.0), random.in(-5.0, 5.0), 0.0};
    if (p[0] > cut || std::hypot(p[0] - hx, p[1] - hy) < hole) {
      if (random.below(60) != 0) continue;
    }
    cloud.push_back(p);
  }
  return cloud;
}

RC_GTEST_PROP(RimShape, AnyFlatCloud_HasTheDepthAndTheDiscOfBruteForce, (std::uint64_t seed)) {
  const BallPoints points = test::ball_of(any_flat_cloud(seed), kRadius);
  RimScratch scratch;
  const RimShape rim = measure_rim(points, kRadius, 0.0, scratch);
  std::vector<double> azimuths;
  for (std::size_t i = 0; i < points.count; ++i) {
    if (std::hypot(points.x[i], points.y[i]) > 0.25) azimuths.push_back(std::atan2(points.y[i], points.x[i]));
  }
  RC_PRE(azimuths.size() >= 3);
  std::sort(azimuths.begin(), azimuths.end());
  double gap = azimuths.front() + 2.0 * kPi - azimuths.back();
  for (std::size_t i = 1; i < azimuths.size(); ++i) gap = std::max(gap, azimuths[i] - azimuths[i - 1]);
  const double gap_deg = gap * kDegreesPerRadian;
  RC_ASSERT(rim.count == static_cast<double>(azimuths.size()));
  RC_CLASSIFY(gap_deg >= kLeastGap_deg, "rim");
  if (gap_deg < kLeastGap_deg) {
    RC_ASSERT(rim.gap_deg < kLeastGap_deg);
    return;
  }
  RC_ASSERT(std::fabs(rim.gap_deg - gap_deg) < 1e-9);
  double depth = std::numeric_limits<double>::infinity();
  double empty = 0.0;
  for (int step = 0; step < 7200; ++step) {
    const double angle = 2.0 * kPi * step / 7200.0;
    const double ex = std::cos(angle), ey = std::sin(angle);
    double support = 0.0;   // Of the hull in this direction.
    double radius = 100.0;  // Of the largest empty disc whose centre lies in this direction.
    for (std::size_t i = 0; i < points.count; ++i) {
      const double along = ex * points.x[i] + ey * points.y[i];
      const double d2 = points.x[i] * points.x[i] + points.y[i] * points.y[i];
      if (d2 <= 16.0) support = std::max(support, along);
      if (d2 > 0.25 * 0.25 && along > 0.0) radius = std::min(radius, 0.5 * d2 / along);
    }
    depth = std::min(depth, support);
    empty = std::max(empty, radius);
  }
  RC_ASSERT(rim.depth <= depth + 1e-6);
  RC_ASSERT(rim.depth >= depth - 5e-3);
  RC_ASSERT(rim.empty_radius >= empty - 1e-6);
  RC_ASSERT(rim.empty_radius <= empty * 1.02 + 1e-6);
}

RC_GTEST_PROP(RimShape, AnyOrder_GivesTheSameBits, (std::uint64_t seed)) {
  std::vector<Vector3> cloud = any_flat_cloud(seed);
  test::disturb(cloud, *rc::gen::element(0.0, 0.2), seed);
  test::rotate(test::any_rotation(seed), cloud);
  const RimShape a = rim_of(cloud, 0.2);
  test::shuffle(cloud, seed);
  const RimShape b = rim_of(cloud, 0.2);
  RC_ASSERT(a.gap_deg == b.gap_deg);
  RC_ASSERT(a.depth == b.depth);
  RC_ASSERT(a.empty_radius == b.empty_radius);
  RC_ASSERT(a.count == b.count);
  RC_ASSERT(a.inner_share == b.inner_share);
  RC_ASSERT(a.offset == b.offset);
  RC_ASSERT(a.rms == b.rms);
  RC_ASSERT(a.nearest == b.nearest);
  RC_ASSERT(a.direction == b.direction);
}

TEST(RimShape, DegeneratePoints_HaveFiniteShapes) {
  std::vector<Vector3> line;
  for (int i = -20; i <= 20; ++i) line.push_back({0.2 * i, 0.0, 0.0});
  for (const auto& cloud : {std::vector<Vector3>{{0, 0, 0}}, std::vector<Vector3>(50, {0, 0, 0}), line,
                            std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}) {
    const RimShape rim = rim_of(cloud);
    for (const double v : {rim.gap_deg, rim.depth, rim.empty_radius, rim.offset, rim.rms, rim.width, rim.nearest[0],
                           rim.nearest[1], rim.nearest[2]}) {
      EXPECT_TRUE(std::isfinite(v));
    }
    EXPECT_LT(rim.width, 0.7) << "nothing here is as wide as a surface";
  }
}

}  // namespace
}  // namespace arris
