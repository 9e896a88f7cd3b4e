#include "features/arris/rim_shape.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

constexpr double kLeastGate = 0.8;
constexpr double kGateDeviations = 3.0;
/// Nearer projections have no azimuth, spacings.
constexpr double kLeastOffset = 0.25;
/// Radius of the disc whose hull is taken: concave rims of radius 15 bulge into it by half a spacing.
constexpr double kHullRadius = 4.0;

/// Azimuths of points this near tell of holes that the whole disc reaches across.
constexpr double kNearDisc = 3.0;
constexpr double kSmallHoleDepth = 1.0;
/// Larger empty discs are not told apart.
constexpr double kMostEmptyRadius = 100.0;

/// Azimuths fall into 32 bins of the pseudo-angle v / (|u| + |v|), 8 per quadrant. A quarter turn is 8 bins wherever it
/// begins, and what 105 degrees have beyond it is more than one bin: such a gap leaves 8 bins in a row empty.
constexpr double kBinsPerQuadrant = 8.0;

std::uint32_t azimuth_bin(double u, double v) {
  const double share = kBinsPerQuadrant * std::fabs(v) / (std::fabs(u) + std::fabs(v));
  const double turned = v >= 0.0 ? (u >= 0.0 ? share : 16.0 - share) : (u < 0.0 ? 16.0 + share : 32.0 - share);
  return std::uint32_t{1} << (static_cast<unsigned>(turned) & 31U);
}

bool may_have_gap(std::uint32_t occupied) {
  std::uint32_t empty = ~occupied;
  empty &= std::rotl(empty, 1);
  empty &= std::rotl(empty, 2);
  empty &= std::rotl(empty, 4);
  return empty != 0;
}

using Planar = std::pair<double, double>;

double turn(const Planar& o, const Planar& a, const Planar& b) {
  return (a.first - o.first) * (b.second - o.second) - (a.second - o.second) * (b.first - o.first);
}

/// Replaces points by their convex hull, counter-clockwise (monotone chain); equal points may be there.
void keep_hull(std::vector<Planar>& points, std::vector<Planar>& hull) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return;
  hull.clear();
  const auto extend = [&hull](const Planar& p, std::size_t floor) {
    while (hull.size() >= floor + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Planar& p : points) extend(p, 0);
  const std::size_t upper = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], upper);
  hull.pop_back();
  points.swap(hull);
}

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

RimShape measure_rim(const BallPoints& points, double radius, double noise, RimScratch& scratch) {
  RimShape shape;
  shape.gate = std::max(kLeastGate, kGateDeviations * noise);
  const FittedPlane plane = own_layer(points, radius, shape.gate, scratch.layer);
  shape.rms = plane.rms;
  shape.width = plane.middle_rms;
  shape.offset = std::fabs(plane.offset);
  scratch.seen.clear();
  scratch.azimuths.clear();
  scratch.inverted.clear();
  std::uint32_t occupied = 0;
  std::uint32_t occupied_near = 0;
  double layer = 0.0;
  double inner = 0.0;
  double beyond = 0.0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const double x = points.x[i], y = points.y[i], z = points.z[i];
    const double d2 = x * x + y * y + z * z;
    const double off = std::fabs(plane.distance(x, y, z));
    if (d2 > radius * radius) continue;
    if (off > shape.gate) {
      beyond += off <= 2.0 * shape.gate ? 1.0 : 0.0;
      continue;
    }
    layer += 1.0;
    inner += off <= 0.5 * shape.gate ? 1.0 : 0.0;
    const double u = plane.e1[0] * x + plane.e1[1] * y + plane.e1[2] * z;
    const double v = plane.e2[0] * x + plane.e2[1] * y + plane.e2[2] * z;
    const double reach2 = u * u + v * v;
    if (reach2 <= kHullRadius * kHullRadius) scratch.seen.emplace_back(u, v);
    if (reach2 > kLeastOffset * kLeastOffset) {
      const std::uint32_t bin = azimuth_bin(u, v);
      occupied |= bin;
      if (reach2 <= kNearDisc * kNearDisc) occupied_near |= bin;
      scratch.inverted.emplace_back(u, v);
    }
  }
  shape.count = static_cast<double>(scratch.inverted.size());
  shape.inner_share = layer > 0.0 ? inner / layer : 0.0;
  shape.beyond_share = layer > 0.0 ? beyond / layer : 0.0;
  if (scratch.inverted.size() < 3 || !(may_have_gap(occupied) || may_have_gap(occupied_near))) return shape;
  for (Planar& p : scratch.inverted) {
    scratch.azimuths.push_back(angle_of(p.second, p.first));
    const double reach2 = p.first * p.first + p.second * p.second;
    p = {p.first / reach2, p.second / reach2};
  }
  std::sort(scratch.azimuths.begin(), scratch.azimuths.end());
  double widest = scratch.azimuths.front() + 2.0 * kPi - scratch.azimuths.back();
  for (std::size_t i = 1; i < scratch.azimuths.size(); ++i) {
    widest = std::max(widest, scratch.azimuths[i] - scratch.azimuths[i - 1]);
  }
  shape.gap_deg = widest * kDegreesPerRadian;
  // Inversion turns discs that touch the centre into half-planes: the largest empty one is where the hull of the
  // inverted points comes closest to the centre.
  scratch.inverted.emplace_back(0.0, 0.0);
  keep_hull(scratch.inverted, scratch.hull);
  Planar nearest, along;
  const double inverse_diameter = hull_depth(scratch.inverted, nearest, along);
  shape.empty_radius = inverse_diameter > 0.5 / kMostEmptyRadius ? 0.5 / inverse_diameter : kMostEmptyRadius;
  const Planar disc_side = along;
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
  return shape;
}

}  // namespace arris
