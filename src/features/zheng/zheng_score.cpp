#include "features/zheng/zheng_score.h"

#include <algorithm>

#include "features/numerics/exact_math.h"

namespace arris {

float contact_score(double distance, double angle_deg, const ZhengSettings& settings) {
  const double near = std::clamp(1.0 - distance / settings.typical.cap, 0.0, 1.0);
  return static_cast<float>(near * std::min(1.0, angle_deg / (2.0 * settings.parameters.angle_deg)));
}

float border_score(double free_deg, const ZhengLengths& lengths) {
  const double half_rad = kPi / 2 - arc_cosine(std::min(lengths.spacing / (2.0 * lengths.alpha), 1.0));
  return static_cast<float>(std::min(1.0, free_deg / (2.0 * half_rad * kDegreesPerRadian)));
}

}  // namespace arris
