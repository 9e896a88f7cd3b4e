#include "features/neighbourhood/plane_fit.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Dense>
#include <bit>
#include <cmath>
#include <cstring>

#include "ball_testing.h"
#include "features/neighbourhood/plane_fits.h"

namespace arris {
namespace {

using test::Random;

constexpr double PointSums::*kSums[] = {&PointSums::n,  &PointSums::x,  &PointSums::y,  &PointSums::z,  &PointSums::xx,
                                        &PointSums::xy, &PointSums::xz, &PointSums::yy, &PointSums::yz, &PointSums::zz};

bool same(const PointSums& a, const PointSums& b) {
  return std::all_of(std::begin(kSums), std::end(kSums), [&](auto sum) { return a.*sum == b.*sum; });
}

/// The sums in plain order over what `in` accepts.
template <class In>
PointSums summed(const BallPoints& points, In&& in) {
  PointSums s;
  for (std::size_t i = 0; i < points.count; ++i) {
    const double x = points.x[i], y = points.y[i], z = points.z[i];
    if (!in(x, y, z)) continue;
    const PointSums p{1, x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
    for (const auto sum : kSums) s.*sum += p.*sum;
  }
  return s;
}

std::vector<Vector3> any_cloud(std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3> points;
  const auto count = 10 + random.below(2000);
  for (std::uint64_t i = 0; i < count; ++i) {
    points.push_back({random.in(-9.0, 9.0), random.in(-9.0, 9.0), random.in(-2.0, 2.0)});
  }
  return points;
}

RC_GTEST_PROP(PlaneFit, AnyOrder_GivesTheSameExactSums, (std::uint64_t seed)) {
  std::vector<Vector3> cloud = any_cloud(seed);
  const BallPoints points = test::ball_of(cloud);
  test::shuffle(cloud, seed + 1);
  const BallPoints shuffled = test::ball_of(cloud);
  Random random(seed);
  const test::Rotation axes = test::any_rotation(seed);
  FittedPlane a = fit_plane(sum_within(points, 6.0));
  FittedPlane b = a;
  b.normal = axes[1];
  const Split split{axes[0], random.in(-1.0, 1.0)};
  const auto on_a = [&](double x, double y, double z) { return dot(split.g, {x, y, z}) > split.h; };
  const auto near = [](const FittedPlane& p, double x, double y, double z, double gate) {
    return std::fabs(dot(p.normal, {x, y, z}) - p.offset) <= gate;
  };

  const PointSums within = summed(points, [](double x, double y, double z) { return x * x + y * y + z * z <= 36.0; });
  RC_ASSERT(same(sum_within(points, 6.0), within));
  RC_ASSERT(same(sum_within(shuffled, 6.0), within));

  const PointSums close = summed(
      points, [&](double x, double y, double z) { return x * x + y * y + z * z <= 36.0 && near(a, x, y, z, 0.5); });
  RC_ASSERT(same(sum_near_plane(points, 6.0, a, 0.5), close));
  RC_ASSERT(same(sum_near_plane(shuffled, 6.0, a, 0.5), close));

  RC_ASSERT(count_near_plane(points, 6.0, a, 0.5) == close.n);

  const PointSums side = summed(points, on_a);
  const PointSums all = summed(points, [](double, double, double) { return true; });
  for (const BallPoints* p : {&points, &shuffled}) {
    RC_ASSERT(same(sum_side(*p, split), side));
    RC_ASSERT(same(sum_all(*p), all));
    const SplitSums gated = sum_split(*p, split, a, b, 1.0);
    RC_ASSERT(same(
        gated.a, summed(points, [&](double x, double y, double z) { return on_a(x, y, z) && near(a, x, y, z, 1.0); })));
    RC_ASSERT(same(gated.b, summed(points, [&](double x, double y, double z) {
                     return !on_a(x, y, z) && near(b, x, y, z, 1.0);
                   })));
  }
  RC_ASSERT(std::bit_cast<std::uint64_t>(mean_cut_square(points, split, a, b, 1.5)) ==
            std::bit_cast<std::uint64_t>(mean_cut_square(shuffled, split, a, b, 1.5)));
}

RC_GTEST_PROP(PlaneFit, ManyAtOnce_HaveTheBitsOfOneByOne, (std::uint64_t seed)) {
  Random random(seed);
  std::vector<PointSums> sums;
  const auto count = 1 + random.below(20);
  for (std::uint64_t i = 0; i < count; ++i) {
    std::vector<Vector3> cloud = any_cloud(seed + i);
    switch (random.below(4)) {  // A string, an axis-aligned plane, a single point, and nothing special.
      case 0:
        std::erase_if(cloud, [](const Vector3& p) { return p[0] < 0.0; });
        for (Vector3& p : cloud) p = {p[0], 2.0 * p[0], 0.0};
        break;
      case 1:
        for (Vector3& p : cloud) p[2] = 0.0;
        break;
      case 2:
        cloud.resize(1);
        break;
      default:
        test::rotate(test::any_rotation(seed + i), cloud);
    }
    sums.push_back(sum_all(test::ball_of(cloud)));
  }
  std::vector<FittedPlane> planes(sums.size());
  fit_planes(sums, planes);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].n == 0.0) continue;
    const FittedPlane one = fit_plane(sums[i]);
    RC_ASSERT(std::memcmp(&planes[i], &one, sizeof one) == 0);
  }
}

RC_GTEST_PROP(PlaneFit, AnyCloud_HasThePlaneOfEigensSolver, (std::uint64_t seed)) {
  std::vector<Vector3> cloud = any_cloud(seed);
  test::rotate(test::any_rotation(seed), cloud);
  const BallPoints points = test::ball_of(cloud, 9.0);
  const FittedPlane plane = fit_plane(sum_within(points, 9.0));
  Eigen::MatrixX3d p(points.count, 3);
  for (std::size_t i = 0; i < points.count; ++i) {
    p.row(static_cast<Eigen::Index>(i)) << points.x[i], points.y[i], points.z[i];
  }
  const Eigen::RowVector3d mean = p.colwise().mean();
  const Eigen::MatrixX3d centred = p.rowwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(centred.transpose() * centred /
                                                              static_cast<double>(points.count));
  const Eigen::Vector3d values = solver.eigenvalues();
  RC_PRE(values(1) - values(0) > 0.05 * values(2));
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  const double cosine = normal.dot(Eigen::Vector3d(plane.normal[0], plane.normal[1], plane.normal[2]));
  RC_ASSERT(std::fabs(cosine) > 1.0 - 1e-12);
  RC_ASSERT(std::fabs(plane.rms - std::sqrt(values(0))) < 1e-9);
  RC_ASSERT(std::fabs(plane.middle_rms - std::sqrt(values(1))) < 1e-9);
  RC_ASSERT(std::fabs(plane.distance(mean(0), mean(1), mean(2))) < 1e-12);
  RC_ASSERT(plane.count == static_cast<double>(points.count));
  RC_ASSERT(std::fabs(dot(plane.normal, plane.e1)) < 1e-12);
}

TEST(PlaneFit, OnePointOrCollinearPoints_GiveAUnitNormalAndNoSpread) {
  for (const int count : {1, 2, 9}) {
    std::vector<Vector3> line;
    for (int i = 0; i < count; ++i) line.push_back({0.5 * i, 0.25 * i, -0.125 * i});
    const FittedPlane plane = fit_plane(sum_within(test::ball_of(line), 12.0));
    EXPECT_NEAR(dot(plane.normal, plane.normal), 1.0, 1e-12);
    EXPECT_NEAR(plane.rms, 0.0, 1e-6);
    EXPECT_NEAR(plane.middle_rms, 0.0, 1e-6);
    for (const Vector3& p : line) EXPECT_NEAR(plane.distance(p[0], p[1], p[2]), 0.0, 1e-6);
  }
}

TEST(PlaneFit, CutSquares_LimitWhatOnePointWeighs) {
  const BallPoints points = test::ball_of({{1, 0, 0}, {1, 1, 0.5}, {-1, 0, -10}, {-1, 1, 0.25}});
  FittedPlane flat;  // z = 0.
  EXPECT_DOUBLE_EQ(mean_cut_square(points, {{1, 0, 0}, 0.0}, flat, flat, 1.5), (0.25 + 2.25 + 0.0625) / 4.0);
}

}  // namespace
}  // namespace arris
