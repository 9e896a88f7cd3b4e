#include "features/liu/liu_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"

namespace arris {
namespace {

void require(bool valid, const char* option, double value, const char* range) {
  if (!valid) throw ConfigError(fmt::format("{} must be {}, not {}", option, range, value));
}

void require_not_negative(const char* option, double value) {
  require(std::isfinite(value) && value >= 0.0, option, value, "finite and not negative");
}

void require_positive(const char* option, double value) {
  require(std::isfinite(value) && value > 0.0, option, value, "finite and greater than 0");
}

}  // namespace

void validate(const LiuParameters& p) {
  require(p.k_min >= 3, "--k-min", p.k_min, "at least 3");
  require(p.k_max >= p.k_min, "--k-max", p.k_max, "at least --k-min");
  require(p.k_max <= 200, "--k-max", p.k_max, "at most 200");
  require(p.k_step >= 1, "--k-step", p.k_step, "at least 1");
  require(p.min_planarity >= 0.0 && p.min_planarity <= 1.0, "--min-planarity", p.min_planarity, "between 0 and 1");
  require(p.gap_deg > 0.0 && p.gap_deg < 360.0, "--gap", p.gap_deg, "between 0 and 360 degrees");
  require_positive("--far-factor", p.far_factor);
  require_not_negative("--far-distance", p.far_distance);
  require_positive("--radius-factor", p.radius_factor);
  require_not_negative("--radius", p.radius);
  require_positive("--cf1-factor", p.cf1_factor);
  require_not_negative("--cf1", p.cf1);
  require(p.fold_angle_deg >= 0.0 && p.fold_angle_deg < 180.0, "--fold-angle", p.fold_angle_deg,
          "at least 0 and below 180 degrees");
  require_not_negative("--noise", p.noise);
  require(std::isfinite(p.cf2) && p.cf2 >= 1.0, "--cf2", p.cf2, "finite and at least 1");
  require(p.top_m >= 1 && p.top_m <= 64, "--top", p.top_m, "between 1 and 64");
  require(p.min_votes >= 1, "--min-votes", p.min_votes, "at least 1");
  require_not_negative("--spacing", p.spacing);
  require_positive("--max-radius", p.max_radius);
  require(!p.fold || p.radius <= p.max_radius, "--radius", p.radius, "at most --max-radius");
}

}  // namespace arris
