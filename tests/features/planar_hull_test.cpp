// Convex hulls in the plane against what hulls are.

#include "features/arris/planar_hull.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "ball_testing.h"

namespace arris {
namespace {

enum class Layout : std::uint8_t { kDisc, kGrid, kLine, kTwo, kInverted };

std::vector<Planar> any_points(Layout layout, std::size_t count, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Planar> points;
  while (points.size() < count) {
    const double u = random.in(-5.0, 5.0), v = random.in(-5.0, 5.0);
    switch (layout) {
      case Layout::kDisc:
        if (u * u + v * v <= 25.0) points.emplace_back(u, v);
        break;
      case Layout::kGrid:
        points.emplace_back(std::round(u), std::round(v));
        break;
      case Layout::kLine:
        points.emplace_back(std::round(u), 2.0 * std::round(u) + 1.0);
        break;
      case Layout::kTwo:
        points.emplace_back(u < 0.0 ? -1.0 : 1.0, 0.0);
        break;
      case Layout::kInverted:
        points.emplace_back(u / (u * u + v * v), v / (u * u + v * v));
        break;
    }
  }
  return points;
}

Layout any_layout() {
  return *rc::gen::element(Layout::kDisc, Layout::kGrid, Layout::kLine, Layout::kTwo, Layout::kInverted);
}

double turn(const Planar& o, const Planar& a, const Planar& b) {
  return (a.first - o.first) * (b.second - o.second) - (a.second - o.second) * (b.first - o.first);
}

RC_GTEST_PROP(PlanarHull, AnyPoints_AreInsideOfAConvexRing, (std::uint64_t seed)) {
  const Layout layout = any_layout();
  const std::vector<Planar> points = any_points(layout, *rc::gen::inRange<std::size_t>(1, 300), seed);
  std::vector<Planar> hull = points;
  HullScratch scratch;
  keep_hull(hull, scratch);
  for (const Planar& corner : hull) RC_ASSERT(std::find(points.begin(), points.end(), corner) != points.end());
  if (hull.size() < 3) {
    for (const Planar& p : points) RC_ASSERT(std::fabs(turn(hull.front(), hull.back(), p)) <= 1e-9);
    return;
  }
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Planar& a = hull[i];
    const Planar& b = hull[(i + 1) % hull.size()];
    RC_ASSERT(turn(a, b, hull[(i + 2) % hull.size()]) > 0.0);
    for (const Planar& p : points) RC_ASSERT(turn(a, b, p) >= -1e-9);
  }
}

RC_GTEST_PROP(PlanarHull, AnyOrder_GivesTheSameBits, (std::uint64_t seed)) {
  std::vector<Planar> a = any_points(any_layout(), *rc::gen::inRange<std::size_t>(1, 600), seed);
  std::vector<Planar> b = a;
  test::shuffle(b, seed + 1);
  HullScratch scratch;
  std::vector<Planar> left_of_a = a, left_of_b = b;
  drop_inner_points(left_of_a, scratch.inner);
  drop_inner_points(left_of_b, scratch.inner);
  std::sort(left_of_a.begin(), left_of_a.end());
  std::sort(left_of_b.begin(), left_of_b.end());
  RC_ASSERT(left_of_a == left_of_b);
  keep_hull(a, scratch);
  keep_hull(b, scratch);
  RC_ASSERT(a == b);
}

TEST(InnerPoints, OfADisc_AreMostlyDropped) {
  std::vector<Planar> points = any_points(Layout::kDisc, 300, 1);
  InnerScratch scratch;
  drop_inner_points(points, scratch);
  EXPECT_LT(points.size(), 60U);
  EXPECT_GE(points.size(), 8U);
}

TEST(InnerPoints, FewOrEqualPoints_StayAsTheyAre) {
  InnerScratch scratch;
  std::vector<Planar> few = any_points(Layout::kDisc, 10, 1);
  const std::vector<Planar> before = few;
  drop_inner_points(few, scratch);
  EXPECT_EQ(few, before);
  std::vector<Planar> equal(100, {3.0, -2.0});
  drop_inner_points(equal, scratch);
  EXPECT_EQ(equal.size(), 100U);
}

}  // namespace
}  // namespace arris
