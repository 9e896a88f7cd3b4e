#include "synth/scan_visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arris::synth {

namespace {
constexpr std::uint32_t kNoFace = std::numeric_limits<std::uint32_t>::max();
constexpr double kLeastFlatRange = 1e-9;  // Straight above or below the scanner any azimuth will do.
}  // namespace

/// One step in azimuth and one in elevation across the ray, metres, and the cosine of incidence that counts.
struct ScanVisibility::Steps {
  Vec3 ray, azimuth, elevation;  ///< Unit ray; the steps as vectors.
  double cosine = 0.0;
  Vec3 normal;  ///< Towards the scanner, tilted so that its cosine is the one that counts.
};

ScanVisibility::ScanVisibility(const SceneModel& model, const ScanGrid& grid)
    : model_(model), grid_(grid), occluders_(model) {
  for (const ScannerStation& station : model.stations) positions_.push_back(station.position);
  positions_.resize(std::min(positions_.size(), kMostStations));
}

StationMask ScanVisibility::every_station() const {
  return static_cast<StationMask>((std::uint64_t{1} << positions_.size()) - 1U);
}

bool ScanVisibility::sees(std::size_t station, const SurfacePoint& point, Scratch& scratch) const {
  const Vec3 ray = point.position - positions_[station];
  const double range = norm(ray);
  if (!(range > 0.0 && range < grid_.max_range)) return false;
  if (ray.z < grid_.min_elevation_sin * range || ray.z > grid_.max_elevation_sin * range) return false;
  if (std::abs(dot(ray, point.normal)) < kLeastCosine * range) return false;
  if (scratch.hints.empty()) scratch.hints.assign(positions_.size(), kNoFace);
  return !occluders_.blocked(positions_[station], point.position, point.face, scratch.hints[station]);
}

StationMask ScanVisibility::seen_by(const SurfacePoint& point, StationMask asked, Scratch& scratch) const {
  StationMask seen = 0;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const StationMask bit = StationMask{1} << i;
    if ((asked & bit) != 0 && sees(i, point, scratch)) seen |= bit;
  }
  return seen;
}

ScanVisibility::Steps ScanVisibility::steps(std::size_t station, const SurfacePoint& point) const {
  const Vec3 to_point = point.position - positions_[station];
  const double range = norm(to_point);
  Steps steps;
  steps.ray = (1.0 / range) * to_point;
  const double flat = std::sqrt(to_point.x * to_point.x + to_point.y * to_point.y);
  const Vec3 east = flat > kLeastFlatRange ? Vec3{-to_point.y / flat, to_point.x / flat, 0.0} : Vec3{0.0, 1.0, 0.0};
  steps.azimuth = flat * grid_.azimuth_step_rad * east;
  steps.elevation = range * grid_.elevation_step_rad * cross(steps.ray, east);
  const double along = dot(steps.ray, point.normal);
  steps.cosine = std::max(std::abs(along), kLeastCosine);
  const Face& face = model_.faces[point.face];
  if (face.shape == Face::Shape::kCylinder) {
    steps.cosine = std::max(steps.cosine, std::min(1.0, std::sqrt(range * grid_.elevation_step_rad / face.radius)));
  }
  const Vec3 towards = along > 0.0 ? -point.normal : point.normal;
  const Vec3 across = normalized(towards + std::abs(along) * steps.ray);
  steps.normal = -steps.cosine * steps.ray + std::sqrt(1.0 - std::min(1.0, steps.cosine * steps.cosine)) * across;
  return steps;
}

double ScanVisibility::density(std::size_t station, const SurfacePoint& point) const {
  const Steps s = steps(station, point);
  return s.cosine / (norm(s.azimuth) * norm(s.elevation));
}

LocalSpacing ScanVisibility::spacing(const SurfacePoint& point, StationMask seen) const {
  LocalSpacing result;
  double points_per_area = 0.0;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    if ((seen >> i & 1U) == 0) continue;
    points_per_area += density(i, point);
    const Steps s = steps(i, point);
    const auto on_surface = [&](const Vec3& step) {
      return step - (dot(step, s.normal) / dot(s.ray, s.normal)) * s.ray;
    };
    const Vec3 a = on_surface(s.azimuth), b = on_surface(s.elevation);
    // Larger singular value of the 3x2 matrix (a b), from its Gram matrix.
    const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b);
    const double coarse = std::sqrt(0.5 * (aa + bb + std::sqrt((aa - bb) * (aa - bb) + 4.0 * ab * ab)));
    if (result.coarse == 0.0 || coarse < result.coarse) result.coarse = coarse;
  }
  if (points_per_area > 0.0) result.mean = 1.0 / std::sqrt(points_per_area);
  return result;
}

double ScanVisibility::facing_spacing(const Vec3& position) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& station : positions_) nearest = std::min(nearest, norm(position - station));
  return nearest * grid_.elevation_step_rad;
}

}  // namespace arris::synth
