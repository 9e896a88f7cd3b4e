#include "features/arris/arris_parameters.h"

#include <cmath>

#include "core/error.h"

namespace arris {

void validate(const ArrisParameters& p) {
  if (!(p.spacing >= 0.0) || !std::isfinite(p.spacing)) throw ConfigError("--spacing must be a length of at least 0");
  if (!(p.max_radius > 0.0) || !std::isfinite(p.max_radius)) throw ConfigError("--max-radius must be a length above 0");
  if (!(p.min_score >= 0.0 && p.min_score <= 1.0)) throw ConfigError("--precision must be from 0 to 1");
  for (const double c : p.viewpoint) {
    if (!std::isfinite(c)) throw ConfigError("--viewpoint must be three finite coordinates");
  }
}

}  // namespace arris
