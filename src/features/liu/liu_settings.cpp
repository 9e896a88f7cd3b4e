#include "features/liu/liu_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "features/neighbourhood/candidate_set.h"
#include "features/numerics/exact_math.h"

namespace arris {
namespace {

/// 0.60 sigma is the standard deviation of |N(0, sigma²)|, what C_f1 shows on flat ground; three times that is no
/// accident.
constexpr double kFlatDeviations = 3.0 * 0.60;

const LiuParameters& checked(const LiuParameters& parameters) {
  validate(parameters);
  return parameters;
}

GapSpan span_of(LiuParameters::Span span) {
  return span == LiuParameters::Span::kBracket ? GapSpan::kBracket : GapSpan::kInner;
}

}  // namespace

LiuSettings::LiuSettings(const LiuParameters& p, const Lattice& lattice, const LiuSwitches& s)
    : parameters(checked(p)),
      switches(s),
      step(lattice.step),
      max_reach(p.max_radius / lattice.step),
      max_d2(0),
      scale{p.k_min, p.k_max, p.k_step, p.covariance_with_target, p.min_planarity},
      gap_test(p.gap_deg, span_of(p.span)) {
  if (!(max_reach <= kMostReach)) {
    throw ConfigError(
        fmt::format("--max-radius {} is {:.3g} lattice steps of {}, more than 2^30: choose a smaller radius or a "
                    "larger lattice step",
                    p.max_radius, max_reach, lattice.step));
  }
  max_d2 = static_cast<std::uint64_t>(max_reach * max_reach);
}

LocalSpacing LiuSettings::spacing(const Neighbours& neighbours) const {
  if (parameters.spacing > 0.0) return {parameters.spacing / step, parameters.spacing / step};
  return local_spacing(neighbours);
}

double LiuSettings::far_distance(const LocalSpacing& spacing) const {
  return parameters.far_distance > 0.0 ? parameters.far_distance / step : parameters.far_factor * spacing.nearest;
}

FoldThresholds LiuSettings::fold_thresholds(const LocalSpacing& spacing) const {
  FoldThresholds t;
  t.radius = parameters.radius > 0.0 ? parameters.radius / step : parameters.radius_factor * spacing.density;
  t.radius = std::min(t.radius, max_reach);
  if (parameters.cf1 > 0.0) {
    t.cf1 = parameters.cf1 / step;
  } else if (parameters.fold_angle_deg > 0.0) {
    const double half_rad = 0.5 * parameters.fold_angle_deg / kDegreesPerRadian;
    t.cf1 = std::max(kFoldLaw * t.radius * std::cos(half_rad), kFlatDeviations * parameters.noise / step);
  } else {
    t.cf1 = parameters.cf1_factor * spacing.density;
  }
  t.cf2 = parameters.cf2;
  t.top_m = parameters.top_m;
  return t;
}

}  // namespace arris
