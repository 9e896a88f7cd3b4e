/// @file What the method `arris` does for many points at once, or leaves out because it cannot matter, against the
/// plain way: one by one, sorted, all of it.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ball_testing.h"
#include "features/arris/azimuth_spread.h"
#include "features/arris/ball_shape.h"
#include "features/arris/judgement.h"
#include "features/arris/layer_view.h"
#include "features/arris/planar_hull.h"
#include "features/arris/quadric_share.h"
#include "features/arris/scatter.h"
#include "features/numerics/exact_math.h"
#include "features/numerics/least_squares.h"

namespace arris {
namespace {

using test::Random;

/// Planes, folds, layers, rims and clouds, with noise or none, with a part cut away or whole.
std::vector<Vector3> any_surface(std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3> points;
  switch (random.below(6)) {
    case 0:
      points = test::plane_points(seed);
      break;
    case 1:
      points = test::fold_points(random.in(40.0, 170.0), seed);
      break;
    case 2:
      points = test::layer_points(random.in(0.5, 4.0), seed);
      break;
    case 3:
      points = test::rim_points(random.in(3.0, 12.0), seed);
      break;
    case 4:
      points = test::column_points(random.in(3.0, 12.0), seed);
      break;
    default:
      for (int i = 0; i < 600; ++i) points.push_back({random.in(-6, 6), random.in(-6, 6), random.in(-6, 6)});
  }
  if (random.below(2) == 0) {
    const double border = random.in(-1.0, 4.0);
    std::erase_if(points, [&](const Vector3& p) { return p[1] > border; });
  }
  const double noise = random.below(3) == 0 ? 0.0 : random.in(0.0, 0.8);
  test::disturb(points, noise, seed);
  if (random.below(4) != 0) test::rotate(test::any_rotation(seed), points);
  points.push_back({0.0, 0.0, 0.0});
  return points;
}

double share_of_one(const BallPoints& points, double radius, const FittedPlane& plane) {
  double m[6][6] = {};
  double y[6] = {};
  double n = 0.0, flat = 0.0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Vector3 p{points.x[i], points.y[i], points.z[i]};
    if (dot(p, p) > radius * radius) continue;
    const double u = on_grid<5>(dot(plane.e1, p)), v = on_grid<5>(dot(plane.e2, p));
    const double w = on_grid<10>(dot(plane.normal, p) - plane.offset);
    const double terms[6] = {1.0, u, v, u * u, u * v, v * v};
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b <= a; ++b) m[a][b] += terms[a] * terms[b];
      y[a] += w * terms[a];
    }
    n += 1.0;
    flat += w * w;
  }
  double x[6] = {};
  double variance = 0.0;
  if (n <= 8.0 || !(flat > 0.0) || !solve_normal_equations<6>(m, y, 6, x, variance)) return 1.0;
  double bent = flat;
  for (int a = 0; a < 6; ++a) bent -= x[a] * y[a];
  return std::sqrt(std::max(bent, 0.0) / (n - 6.0) / (flat / (n - 3.0)));
}

RC_GTEST_PROP(ManyAtOnce, QuadricShares_HaveTheBitsOfOneByOne, (std::uint64_t seed)) {
  std::vector<BallPoints> points;
  std::vector<const BallPoints*> balls;
  std::vector<FittedPlane> planes;
  const double radius = *rc::gen::element(1.5, 3.0, 5.0);
  for (std::uint64_t i = 0; i < 11; ++i) points.push_back(test::ball_of(any_surface(seed + i), 5.0));
  for (const BallPoints& p : points) {
    balls.push_back(&p);
    planes.push_back(fit_plane(sum_within(p, radius)));
  }
  std::vector<double> shares(balls.size());
  quadric_shares(balls, radius, planes, shares);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    RC_ASSERT(shares[i] == share_of_one(points[i], radius, planes[i]));
  }
}

RC_GTEST_PROP(ManyAtOnce, Scatter_IsWhatThreeQuestionsSay, (std::uint64_t seed)) {
  std::vector<BallPoints> points;
  std::vector<const BallPoints*> balls;
  for (std::uint64_t i = 0; i < 8; ++i) points.push_back(test::ball_of(any_surface(seed + i), 5.0));
  for (const BallPoints& p : points) balls.push_back(&p);
  ScatterScratch scratch;
  std::vector<std::uint8_t> scatters(balls.size());
  find_scatter(balls, scratch, scatters);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const FittedPlane near = fit_plane(sum_within(points[i], 3.0));
    const FittedPlane all = fit_plane(sum_within(points[i], 5.0));
    const bool expected = share_of_one(points[i], 3.0, near) >= 0.8 && share_of_one(points[i], 5.0, all) >= 0.9 &&
                          sum_near_plane(points[i], 5.0, all, 0.5 * all.rms).n >= 0.25 * all.count;
    RC_ASSERT((scatters[i] != 0) == expected);
  }
}

RC_GTEST_PROP(ManyAtOnce, Shapes_HaveTheBitsOfOneByOne, (std::uint64_t seed)) {
  Random random(seed);
  std::vector<BallMeasure> balls;
  const auto count = 1 + random.below(20);
  for (std::uint64_t i = 0; i < count; ++i) {
    const PointSums s = sum_all(test::ball_of(any_surface(seed + i), 5.0));
    balls.push_back({{s.n, s.x, s.y, s.z, s.xx, s.xy, s.xz, s.yy, s.yz, s.zz}, 5.0, random.in(0.5, 2.0)});
  }
  std::vector<BallShape> shapes(balls.size());
  measure_shapes(balls, shapes);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto& [m, radius, spacing] = balls[i];
    const Eigenvalues<double> values = eigenvalues_of(m.covariance());
    RC_ASSERT(shapes[i].count == m.n);
    RC_ASSERT(shapes[i].rms == std::sqrt(std::max(values.smallest, 0.0)) / spacing);
    RC_ASSERT(shapes[i].middle_rms == std::sqrt(std::max(values.middle, 0.0)) / spacing);
    RC_ASSERT(shapes[i].off_centre == std::sqrt(m.x * m.x + m.y * m.y + m.z * m.z) / (m.n * radius));
  }
}

RC_GTEST_PROP(AzimuthSpread, WidestGap_IsThatOfSortedAzimuths, (std::uint64_t seed)) {
  Random random(seed);
  const auto n = static_cast<std::size_t>(1 + random.below(300));
  const bool on_axes = random.below(3) == 0;
  const double turn = random.in(0.1, 2.0);
  std::vector<double> u(simd::padded(n)), v(simd::padded(n)), sorted;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = on_axes ? kPi / 4.0 * static_cast<double>(random.below(8)) : turn * random.normal();
    const double reach = random.in(0.3, 5.0);
    u[i] = on_grid<9>(reach * std::cos(angle));
    v[i] = on_grid<9>(reach * std::sin(angle));
    sorted.push_back(angle_of(v[i], u[i]));
  }
  std::sort(sorted.begin(), sorted.end());
  double widest = sorted.front() + 2.0 * kPi - sorted.back();
  for (std::size_t i = 1; i < n; ++i) widest = std::max(widest, sorted[i] - sorted[i - 1]);
  AzimuthScratch scratch;
  RC_ASSERT(widest_azimuth_gap(u.data(), v.data(), n, scratch) == widest);
}

RC_GTEST_PROP(PlanarHull, Sorting_IsThatOfPairs, (std::uint64_t seed)) {
  Random random(seed);
  std::vector<Planar> points;
  const bool coarse = random.below(2) == 0;  // Full of equal abscissae and equal points.
  const auto count = random.below(700);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Planar p{random.in(-4.0, 4.0), random.in(-4.0, 4.0)};
    points.push_back(coarse ? Planar{std::round(p.first), std::round(p.second)} : p);
  }
  std::vector<Planar> expected = points;
  std::sort(expected.begin(), expected.end());
  HullScratch scratch;
  sort_planar(points, scratch);
  RC_ASSERT(points == expected);
}

/// Bin of the pseudo-angle, point by point.
std::uint32_t bin_of(double u, double v) {
  const double share = 8.0 * std::fabs(v) / (std::fabs(u) + std::fabs(v));
  const double turned = v >= 0.0 ? (u >= 0.0 ? share : 16.0 - share) : (u < 0.0 ? 16.0 + share : 32.0 - share);
  return std::uint32_t{1} << (static_cast<unsigned>(turned) & 31U);
}

bool eight_empty_in_a_row(std::uint32_t occupied) {
  for (int first = 0; first < 32; ++first) {
    bool empty = true;
    for (int k = 0; k < 8; ++k) empty = empty && (occupied >> ((first + k) % 32) & 1U) == 0;
    if (empty) return true;
  }
  return false;
}

RC_GTEST_PROP(LayerView, AnyBall_IsSeenAsPointByPoint, (std::uint64_t seed)) {
  const BallPoints points = test::ball_of(any_surface(seed), 5.0);
  const FittedPlane plane = fit_plane(sum_within(points, *rc::gen::element(2.2, 5.0)));
  const double gate = *rc::gen::element(0.1, 0.8);
  LayerView view;
  look_at_layer(points, 5.0, plane, gate, view);
  double count = 0, inner = 0, beyond = 0, azimuths = 0;
  std::uint32_t occupied = 0, occupied_near = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const double x = points.x[i], y = points.y[i], z = points.z[i];
    const double off = std::fabs(plane.distance(x, y, z));
    const bool in = x * x + y * y + z * z <= 25.0;
    RC_ASSERT((view.reach2[i] >= 0.0) == (in && off <= gate));
    if (!in) continue;
    if (off > gate) {
      beyond += off <= 2.0 * gate ? 1.0 : 0.0;
      continue;
    }
    count += 1.0;
    inner += off <= 0.5 * gate ? 1.0 : 0.0;
    const double u = plane.e1[0] * x + plane.e1[1] * y + plane.e1[2] * z;
    const double v = plane.e2[0] * x + plane.e2[1] * y + plane.e2[2] * z;
    RC_ASSERT(view.u[i] == u && view.v[i] == v && view.reach2[i] == u * u + v * v);
    if (u * u + v * v <= kLeastOffset * kLeastOffset) continue;
    azimuths += 1.0;
    occupied |= bin_of(u, v);
    if (u * u + v * v <= kNearDisc * kNearDisc) occupied_near |= bin_of(u, v);
  }
  RC_ASSERT(view.count == count && view.inner == inner && view.beyond == beyond && view.azimuths == azimuths);
  RC_ASSERT(view.may_have_gap == (eight_empty_in_a_row(occupied) || eight_empty_in_a_row(occupied_near)));
}

/// What the first half of the measurement refuses is refused after the second half as well.
RC_GTEST_PROP(Rim, RefusedEarly_IsRefusedLate, (std::uint64_t seed)) {
  const BallPoints points = test::ball_of(any_surface(seed), 5.0);
  RimScratch scratch;
  const RimShape early = look_for_gap(points, 5.0, 0.1, scratch);
  const RimShape late = measure_rim(points, 5.0, 0.1, scratch);
  RC_ASSERT(early.gap_deg == late.gap_deg && early.count == late.count && early.rms == late.rms);
  RC_ASSERT(may_be_rim(early) == may_be_rim(late));
  PointContour contour;
  RC_ASSERT(may_be_rim(early) || !judge_rim(late, 0.1, contour));
}

}  // namespace
}  // namespace arris
