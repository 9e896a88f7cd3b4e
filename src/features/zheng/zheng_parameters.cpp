#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "features/zheng/zheng_method.h"
#include "features/zheng/zheng_settings.h"

namespace arris {
namespace {

void require(bool valid, const char* option, double value, const char* range) {
  if (!valid) throw ConfigError(fmt::format("{} must be {}, not {}", option, range, value));
}

void require_positive(const char* option, double value) {
  require(std::isfinite(value) && value > 0.0, option, value, "finite and greater than 0");
}

void require_not_negative(const char* option, double value) {
  require(std::isfinite(value) && value >= 0.0, option, value, "finite and not negative");
}

}  // namespace

void validate(const ZhengParameters& p) {
  require_positive("--spacing", p.spacing);
  require(p.angle_deg > 0.0 && p.angle_deg < 90.0, "--plane-angle", p.angle_deg, "between 0 and 90 degrees");
  require_not_negative("--contact-cap", p.contact_cap);
  require_positive("--contact-factor", p.contact_factor);
  require_not_negative("--alpha", p.alpha);
  require_positive("--alpha-factor", p.alpha_factor);
  require_not_negative("--seam-distance", p.seam_distance);
  require_positive("--seam-factor", p.seam_factor);
}

double zheng_halo(const ZhengParameters& parameters) {
  return zheng_reach(parameters);
}

}  // namespace arris
