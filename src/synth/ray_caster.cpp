#include "synth/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace arris::synth {

namespace {

// Culling bounds are widened by this (radians, sines, metres), far above the rounding of their computation.
constexpr double kMargin = 1e-6;
constexpr double kPi = std::numbers::pi;

/// Corners of a convex region whose projection along z holds that of the face, in order round it.
std::vector<Vec3> hull(const Face& face) {
  if (face.shape == Face::Shape::kCylinder) {
    const Vec3 u = face.radius * face.eu, v = face.radius * face.ev;
    return {face.origin - u - v, face.origin + u - v, face.origin + u + v, face.origin - u + v};
  }
  return {face.at(0, 0), face.at(face.size_u, 0), face.at(face.size_u, face.size_v), face.at(0, face.size_v)};
}

/// Distance of the origin to the segment a-b in the plane, z ignored.
double flat_distance(const Vec3& a, const Vec3& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0.0 ? std::clamp(-(a.x * dx + a.y * dy) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(a.x + t * dx, a.y + t * dy);
}

/// Equally near faces: the smaller index, so that the order of tests has no influence.
bool nearer(double range, std::uint32_t face, const RayHit& best) {
  return range > 0.0 && (range < best.range || (range == best.range && face < best.face));
}

bool surrounds_origin(const std::vector<Vec3>& corners) {
  int left = 0, right = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double side = a.x * b.y - a.y * b.x;
    if (side >= 0.0) ++left;
    if (side <= 0.0) ++right;
  }
  return left == static_cast<int>(corners.size()) || right == static_cast<int>(corners.size());
}

double elevation_sine(double height, double distance) {
  const double range = std::hypot(height, distance);
  return range > 0.0 ? height / range : 0.0;
}

std::size_t bin_of(double elevation_sin) {
  const double place = (elevation_sin + 1.0) * 0.5 * static_cast<double>(RayCaster::Column::kBins);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(RayCaster::Column::kBins - 1)));
}

}  // namespace

RayCaster::Target RayCaster::make_target(const Face& face, std::uint32_t index, const Vec3& position) {
  Target target;
  target.face = &face;
  target.index = index;
  const Vec3 local = position - face.origin;
  target.ou = dot(local, face.eu);
  target.ov = dot(local, face.ev);
  target.ow = dot(local, face.ew);

  std::vector<Vec3> corners = hull(face);
  for (Vec3& corner : corners) corner = corner - position;
  const Box3 bounds = face.bounds();
  const double low = bounds.min.z - position.z, high = bounds.max.z - position.z;
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    nearest = std::min(nearest, flat_distance(corners[i], corners[(i + 1) % corners.size()]));
    farthest = std::max(farthest, std::hypot(corners[i].x, corners[i].y));
  }
  if (surrounds_origin(corners)) nearest = 0.0;
  const double height = std::max({low, 0.0, -high});
  target.min_range = std::max(0.0, std::hypot(nearest, height) - kMargin);
  target.max_elevation_sin = elevation_sine(high, high > 0.0 ? nearest : farthest) + kMargin;
  target.min_elevation_sin = elevation_sine(low, low < 0.0 ? nearest : farthest) - kMargin;

  // Seen from outside, a convex region spans less than half a turn, with the direction of its middle inside.
  target.all_azimuths = nearest < 1e-3;
  Vec3 middle;
  for (const Vec3& corner : corners) middle = middle + corner;
  target.azimuth = std::atan2(middle.y, middle.x);
  for (const Vec3& corner : corners) {
    const double difference = std::remainder(std::atan2(corner.y, corner.x) - target.azimuth, 2.0 * kPi);
    target.half_width = std::max(target.half_width, std::abs(difference) + kMargin);
  }
  return target;
}

RayCaster::RayCaster(const SceneModel& model, const Vec3& position, double max_range) : max_range_(max_range) {
  for (std::size_t i = 0; i < model.faces.size(); ++i) {
    targets_.push_back(make_target(model.faces[i], static_cast<std::uint32_t>(i), position));
  }
  std::stable_sort(targets_.begin(), targets_.end(),
                   [](const Target& a, const Target& b) { return a.min_range < b.min_range; });
}

void RayCaster::start_column(Column& column, double azimuth_sin, double azimuth_cos) const {
  column.sin = azimuth_sin;
  column.cos = azimuth_cos;
  for (auto& bin : column.bins) bin.clear();
  const double azimuth = std::atan2(azimuth_sin, azimuth_cos);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Target& target = targets_[i];
    if (target.min_range > max_range_) break;
    if (!target.all_azimuths && std::abs(std::remainder(azimuth - target.azimuth, 2.0 * kPi)) > target.half_width)
      continue;
    const std::size_t last = bin_of(target.max_elevation_sin);
    for (std::size_t bin = bin_of(target.min_elevation_sin); bin <= last; ++bin) {
      column.bins[bin].push_back(static_cast<std::uint32_t>(i));
    }
  }
}

RayHit RayCaster::cast(const Column& column, double elevation_sin, double elevation_cos) const {
  const Vec3 direction{elevation_cos * column.cos, elevation_cos * column.sin, elevation_sin};
  RayHit best{max_range_, 0.0, 0};
  for (const std::uint32_t i : column.bins[bin_of(elevation_sin)]) {
    if (targets_[i].min_range > best.range) break;
    intersect(targets_[i], direction, best);
  }
  return best.range < max_range_ ? best : RayHit{};
}

RayHit RayCaster::cast_all(const Column& column, double elevation_sin, double elevation_cos) const {
  const Vec3 direction{elevation_cos * column.cos, elevation_cos * column.sin, elevation_sin};
  RayHit best{max_range_, 0.0, 0};
  for (const Target& target : targets_) intersect(target, direction, best);
  return best.range < max_range_ ? best : RayHit{};
}

void RayCaster::intersect(const Target& target, const Vec3& direction, RayHit& best) const {
  const Face& face = *target.face;
  const double dw = dot(direction, face.ew);
  if (face.shape == Face::Shape::kPlane) {
    const double range = -target.ow / dw;  // Infinite or NaN for a ray in the plane: fails the comparison.
    if (!nearer(range, target.index, best)) return;
    const double u = target.ou + range * dot(direction, face.eu);
    const double v = target.ov + range * dot(direction, face.ev);
    if (face.owns(u, v)) best = {range, std::abs(dw), target.index};
    return;
  }
  const double du = dot(direction, face.eu), dv = dot(direction, face.ev);
  const double a = du * du + dv * dv;
  const double b = target.ou * du + target.ov * dv;
  const double c = target.ou * target.ou + target.ov * target.ov - face.radius * face.radius;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.0) || !(a > 0.0)) return;
  const double root = std::sqrt(discriminant);
  for (const double sign : {-1.0, 1.0}) {
    const double range = (-b + sign * root) / a;
    if (!nearer(range, target.index, best)) continue;
    const double along = target.ow + range * dw;
    if (along < 0.0 || along >= face.size_v) continue;
    const double nu = target.ou + range * du, nv = target.ov + range * dv;
    best = {range, std::abs(nu * du + nv * dv) / face.radius, target.index};
    return;
  }
}

}  // namespace arris::synth
