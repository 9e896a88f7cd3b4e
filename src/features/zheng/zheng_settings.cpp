#include "features/zheng/zheng_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "features/planar/plane_frame.h"

namespace arris {
namespace {

/// Squares of distances up to this many steps are exact in double.
constexpr double kMostSteps = 67108864.0;  // 2^26

/// @param spacing, unit  in data units; the lengths are multiples of `unit`.
ZhengLengths lengths_at(const ZhengParameters& p, double spacing, double unit) {
  const auto length = [&](double fixed, double factor) { return (fixed > 0.0 ? fixed : factor * spacing) / unit; };
  ZhengLengths l;
  l.spacing = spacing / unit;
  l.cap = length(p.contact_cap, p.contact_factor);
  l.alpha = length(p.alpha, p.alpha_factor);
  l.seam = length(p.seam_distance, p.seam_factor);
  return l;
}

const ZhengParameters& checked(const ZhengParameters& parameters) {
  validate(parameters);
  return parameters;
}

}  // namespace

double zheng_reach(const ZhengParameters& p) {
  const ZhengLengths most = lengths_at(p, p.spacing * (p.improved ? kMostLocalSpacing : 1.0), 1.0);
  double reach = 0.0;
  if (p.boundary) reach = std::max({reach, 2.0 * most.alpha, most.seam});
  // Improved, nearest neighbours need not be mutual: the ball around the point decides.
  if (p.fold) reach = std::max(reach, (p.improved ? 1.0 : 2.0) * most.cap);
  if (p.improved) reach = std::max(reach, kLargestJudgedBall * p.spacing);
  return reach * (1.0 + kFrameError);
}

ZhengSettings::ZhengSettings(const ZhengParameters& p, const Lattice& lattice)
    : parameters(checked(p)), step(lattice.step) {
  const double reach = zheng_reach(p) / step;
  if (!(reach <= kMostSteps)) {
    throw ConfigError(
        fmt::format("--spacing {} makes the supervoxels' contours look {:.3g} lattice steps of {} around each point, "
                    "more than 2^26: choose smaller lengths or a larger lattice step",
                    p.spacing, reach, step));
  }
  typical = lengths_at(p, p.spacing, step);
}

ZhengLengths ZhengSettings::lengths(const SupervoxelTable& table, std::uint32_t label) const {
  if (!parameters.improved) return typical;
  const double times = std::clamp(static_cast<double>(table.spacing[label]) / typical.spacing, 1.0, kMostLocalSpacing);
  return lengths_at(parameters, parameters.spacing * times, step);
}

}  // namespace arris
