#include "features/neighbourhood/ball_points.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ball_testing.h"

namespace arris {
namespace {

using Member = std::array<double, 3>;

std::vector<Member> members(const BallPoints& points) {
  std::vector<Member> all;
  for (std::size_t i = 0; i < points.count; ++i) all.push_back({points.x[i], points.y[i], points.z[i]});
  std::sort(all.begin(), all.end());
  return all;
}

/// The ball around the first position, in T.
template <class T>
BallPoints collected(const std::vector<LatticePoint>& positions, double radius, double spacing) {
  std::vector<std::uint64_t> ids(positions.size());
  const PointTree tree(positions, ids);
  const LatticePoint c = positions[0];
  CandidateSet<T> candidates;
  BallPoints points;
  if (!candidates.gather(tree, {{c.x, c.y, c.z}, {c.x, c.y, c.z}}, radius)) throw std::runtime_error("not exact");
  BallQuery<T> query;
  query.x = static_cast<T>(c.x - candidates.origin[0]);
  query.y = static_cast<T>(c.y - candidates.origin[1]);
  query.z = static_cast<T>(c.z - candidates.origin[2]);
  query.radius2 = static_cast<T>(static_cast<std::uint64_t>(radius * radius));
  collect_ball(candidates, query, spacing, points);
  return points;
}

std::vector<LatticePoint> any_positions(std::uint64_t seed, std::int32_t extent) {
  test::Random random(seed);
  std::vector<LatticePoint> positions;
  const auto coordinate = [&] {
    return static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(2 * extent + 1))) - extent;
  };
  for (int i = 0; i < 300; ++i) positions.push_back({coordinate(), coordinate(), coordinate()});
  return positions;
}

RC_GTEST_PROP(BallPoints, AnyBall_HoldsItsMembersRoundedToTheGrid, (std::uint64_t seed)) {
  const std::int32_t extent = *rc::gen::element(20, 300, 1500);
  const std::vector<LatticePoint> positions = any_positions(seed, extent);
  const double radius = extent * *rc::gen::element(0.3, 0.8, 1.1);
  const double spacing = radius / *rc::gen::element(3.0, 5.0, 13.0) * 1.0000001;
  std::vector<Member> expected;
  for (const LatticePoint& p : positions) {
    if (static_cast<double>(squared_distance(p, positions[0])) > std::floor(radius * radius)) continue;
    Member m;
    for (int axis = 0; axis < 3; ++axis) {
      const double inverse = 1.0 / spacing;
      m[axis] = std::nearbyint((static_cast<double>(p[axis]) - positions[0][axis]) * inverse * 512.0) / 512.0;
    }
    expected.push_back(m);
  }
  std::sort(expected.begin(), expected.end());
  RC_ASSERT(members(collected<float>(positions, radius, spacing)) == expected);
  RC_ASSERT(members(collected<double>(positions, radius, spacing)) == expected);
  RC_ASSERT(members(collected<std::int64_t>(positions, radius, spacing)) == expected);
}

TEST(BallPoints, Padding_IsThereAndIsNoPoint) {
  const BallPoints points = collected<double>(any_positions(1, 100), 90.0, 10.0);
  ASSERT_GT(points.count, 0U);
  ASSERT_GE(points.x.size(), points.padded_count());
  EXPECT_EQ(points.padded_count() % simd::kPadding, 0U);
  for (std::size_t i = points.count; i < points.padded_count(); ++i) {
    EXPECT_EQ(points.x[i], BallPoints::kPaddingCoordinate);
  }
}

TEST(BallPoints, HalvesAreRoundedToEven) {
  EXPECT_EQ((on_grid<3>(0.0625)), 0.0);
  EXPECT_EQ((on_grid<3>(0.1875)), 0.25);
  EXPECT_EQ((on_grid<3>(-0.1875)), -0.25);
  EXPECT_EQ((on_grid<9>(-3.0)), -3.0);
}

TEST(BallPoints, HugeDistances_KeepTheirMembers) {
  // Millions of steps between points: only integers are exact.
  std::vector<LatticePoint> positions{{-2000000000, 2000000000, 0}};
  for (int i = 1; i < 20; ++i) positions.push_back({-2000000000 + 50000001 * i, 2000000000, 7});
  const BallPoints points = collected<std::int64_t>(positions, 500000010.0, 1.0e8);
  EXPECT_EQ(points.count, 10U);
  for (std::size_t i = 0; i < points.count; ++i) EXPECT_LE(std::fabs(points.x[i]), 5.01);
}

}  // namespace
}  // namespace arris
