#include "features/arris/rim_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

constexpr double kLeastGate = 0.8;
constexpr double kGateDeviations = 3.0;
/// Radius of the disc whose hull is taken: concave rims of radius 15 bulge into it by half a spacing.
constexpr double kHullRadius = 4.0;

constexpr double kSmallHoleDepth = 1.0;
/// Larger empty discs are not told apart.
constexpr double kMostEmptyRadius = 100.0;

/// Distance of the origin, which is one of the points, to their hull's border, and the direction of that border.
double hull_depth(const std::vector<Planar>& hull, Planar& nearest, Planar& along) {
  nearest = {0.0, 0.0};
  along = {1.0, 0.0};
  if (hull.size() < 3) return 0.0;
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Planar& a = hull[i];
    const Planar& b = hull[(i + 1) % hull.size()];
    const double ex = b.first - a.first, ey = b.second - a.second;
    const double length2 = ex * ex + ey * ey;
    const double area = a.first * ey - a.second * ex;  // Twice the signed area of the triangle with the origin.
    const double distance = std::fabs(area) / std::sqrt(length2);
    if (distance >= depth) continue;
    depth = distance;
    nearest = {area * ey / length2, -area * ex / length2};
    along = {ex / std::sqrt(length2), ey / std::sqrt(length2)};
  }
  return depth;
}

/// Points of the near disc that lie on the other side than `outward`, within 60 degrees.
double count_opposite(const std::vector<Planar>& seen, const Planar& outward) {
  double count = 0.0;
  for (const Planar& p : seen) {
    const double reach2 = p.first * p.first + p.second * p.second;
    const double towards = p.first * outward.first + p.second * outward.second;
    if (reach2 <= kNearDisc * kNearDisc && towards < 0.0 && towards * towards >= 0.25 * reach2) count += 1.0;
  }
  return count;
}

}  // namespace

RimShape look_for_gap(const BallPoints& points, double radius, double noise, RimScratch& scratch) {
  RimShape shape;
  shape.gate = std::max(kLeastGate, kGateDeviations * noise);
  scratch.plane = own_layer(points, radius, shape.gate, scratch.layer);
  shape.rms = scratch.plane.rms;
  shape.width = scratch.plane.middle_rms;
  shape.offset = std::fabs(scratch.plane.offset);
  LayerView& view = scratch.view;
  look_at_layer(points, radius, scratch.plane, shape.gate, view);
  shape.count = view.azimuths;
  shape.inner_share = view.count > 0.0 ? view.inner / view.count : 0.0;
  shape.beyond_share = view.count > 0.0 ? view.beyond / view.count : 0.0;
  if (view.azimuths < 3.0 || !view.may_have_gap) return shape;
  const std::size_t room = simd::padded(points.count);
  if (scratch.u.size() < room) {
    scratch.u.resize(room);
    scratch.v.resize(room);
  }
  std::size_t n = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    scratch.u[n] = view.u[i];
    scratch.v[n] = view.v[i];
    n += view.reach2[i] > kLeastOffset * kLeastOffset;
  }
  shape.gap_deg = widest_azimuth_gap(scratch.u.data(), scratch.v.data(), n, scratch.azimuths) * kDegreesPerRadian;
  return shape;
}

void measure_beside_gap(RimScratch& scratch, RimShape& shape) {
  const FittedPlane& plane = scratch.plane;
  const LayerView& view = scratch.view;
  // Inversion turns discs that touch the centre into half-planes: the largest empty one is where the hull of the
  // inverted points comes closest to the centre.
  const auto n = static_cast<std::size_t>(shape.count);
  scratch.inverted.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const double u = scratch.u[i], v = scratch.v[i];
    const double reach2 = u * u + v * v;
    scratch.inverted.emplace_back(u / reach2, v / reach2);
  }
  scratch.inverted.emplace_back(0.0, 0.0);
  keep_hull(scratch.inverted, scratch.hull);
  Planar nearest, along;
  const double inverse_diameter = hull_depth(scratch.inverted, nearest, along);
  shape.empty_radius = inverse_diameter > 0.5 / kMostEmptyRadius ? 0.5 / inverse_diameter : kMostEmptyRadius;
  const Planar disc_side = along;
  scratch.seen.clear();
  for (std::size_t i = 0; i < view.points; ++i) {
    const bool seen = view.reach2[i] >= 0.0 && view.reach2[i] <= kHullRadius * kHullRadius;
    if (seen) scratch.seen.emplace_back(view.u[i], view.v[i]);
  }
  shape.opposite = count_opposite(scratch.seen, {along.second, -along.first});
  scratch.seen.emplace_back(0.0, 0.0);
  keep_hull(scratch.seen, scratch.hull);
  shape.depth = hull_depth(scratch.seen, nearest, along);
  if (shape.depth > kSmallHoleDepth) {  // The hull spans a hole: the rim is where the disc touches.
    nearest = {0.0, 0.0};
    along = disc_side;
  }
  for (int axis = 0; axis < 3; ++axis) {
    shape.direction[axis] = along.first * plane.e1[axis] + along.second * plane.e2[axis];
    shape.nearest[axis] =
        plane.offset * plane.normal[axis] + nearest.first * plane.e1[axis] + nearest.second * plane.e2[axis];
  }
}

RimShape measure_rim(const BallPoints& points, double radius, double noise, RimScratch& scratch) {
  RimShape shape = look_for_gap(points, radius, noise, scratch);
  if (shape.gap_deg > 0.0) measure_beside_gap(scratch, shape);
  return shape;
}

}  // namespace arris
