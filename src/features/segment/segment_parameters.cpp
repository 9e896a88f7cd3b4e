#include "features/segment/segment_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "features/numerics/exact_math.h"
#include "features/segment/neighbourhood_batch.h"

namespace arris {
namespace {

/// Distances of k-th neighbours scatter; this covers nearly all.
constexpr double kHaloMargin = 1.5;

void require(bool valid, const char* option, double value, const char* range) {
  if (!valid) throw ConfigError(fmt::format("{} must be {}, not {}", option, range, value));
}

bool is_length(double value) {
  return std::isfinite(value) && value >= 0.0;
}

}  // namespace

std::size_t SegmentParameters::most_neighbours() const {
  if (radius > 0.0) return kMostNeighbours;
  return adaptive() ? most_by_noise : neighbours.value_or(kFewestNeighbours);
}

NeighbourRule neighbour_rule(const SegmentParameters& parameters, double step) {
  if (!parameters.adaptive()) return NeighbourRule(parameters.most_neighbours());
  return {parameters.noise / step, parameters.most_by_noise};
}

void validate(const SegmentParameters& p) {
  const std::size_t k = p.neighbours.value_or(kFewestNeighbours);
  require(k >= 3 && k <= kMostNeighbours, "--neighbours", static_cast<double>(k), "between 3 and 64");
  require(is_length(p.radius), "--radius", p.radius, "finite and not negative");
  require(is_length(p.max_radius), "--max-radius", p.max_radius, "finite and not negative");
  require(is_length(p.inlier_distance), "--inlier-distance", p.inlier_distance, "finite and not negative");
  require(p.angle_deg > 0.0 && p.angle_deg < 90.0, "--angle", p.angle_deg, "between 0 and 90 degrees");
  require(p.least_intensity_step() >= 1, "--intensity-step", p.least_intensity_step(), "at least 1");
  require(p.curvature > 0.0 && p.curvature <= 1.0, "--curvature", p.curvature, "above 0, at most 1");
  require(p.min_points >= 1, "--min-points", p.min_points, "at least 1");
  require(p.agreement.value_or(0.0) >= 0.0 && p.agreement.value_or(0.0) <= 1.0, "--agreement", *p.agreement,
          "between 0 and 1");
  require(p.sweep_count() >= 0 && p.sweep_count() <= 10, "--sweeps", p.sweep_count(), "between 0 and 10");
  require(is_length(p.reassign_distance), "--reassign-distance", p.reassign_distance, "finite and not negative");
}

double segment_halo(const SegmentParameters& parameters, double spacing) {
  // On a surface k neighbours fill a disc of radius sqrt(k / pi) spacings. A point, its neighbours, and theirs where
  // they must agree.
  const double rings = parameters.published ? 2.0 : 3.0;
  const std::size_t by_noise = spacing > 0.0 ? neighbours_for(parameters.noise / spacing) : kFewestNeighbours;
  const std::size_t most = parameters.most_neighbours();
  const double k = static_cast<double>(parameters.adaptive() ? std::min(by_noise, most) : most);
  const double ring = parameters.radius > 0.0 ? parameters.radius : kHaloMargin * std::sqrt((k + 1.0) / kPi) * spacing;
  return std::min(rings * ring, rings * parameters.reach());
}

}  // namespace arris
