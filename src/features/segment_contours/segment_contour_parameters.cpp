#include "features/segment_contours/segment_contour_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "features/planar/plane_frame.h"

namespace arris {
namespace {

/// Squares of distances up to this many steps are exact in double.
constexpr double kMostSteps = 67108864.0;  // 2^26
/// The slab around a plane that its shape is made of: so many times the rms distance of the points, but at least one
/// and at most two alpha. What bends out of it is no plane.
constexpr double kSlabRms = 4.0;
constexpr double kMostSlabAlphas = 2.0;
/// Noise moves the points and the line: the distance from the line that is allowed is at least so many rms, at most
/// twice what it would be without noise.
constexpr double kLineRms = 2.0;
constexpr double kMostLine = 2.0;
/// In random samplings the outermost points of a segment may be this many times farther from the fold than fold points.
constexpr double kExplain = 2.0;
/// A sparse segment supports the folds of a dense one with points this many times farther than the dense one's own.
constexpr double kSparser = 2.0;

void require(bool valid, const char* option, double value, const char* range) {
  if (!valid) throw ConfigError(fmt::format("{} must be {}, not {}", option, range, value));
}

void require_factor(const char* option, double value, double least, const char* range) {
  require(std::isfinite(value) && value >= least && value <= 100.0, option, value, range);
}

}  // namespace

void validate(const SegmentContourParameters& p) {
  require_factor("--alpha-factor", p.alpha_factor, 1.0, "between 1 and 100");
  require(p.fold_angle_deg > 0.0 && p.fold_angle_deg < 90.0, "--fold-angle", p.fold_angle_deg,
          "between 0 and 90 degrees");
  require_factor("line_factor", p.line_factor, 0.1, "between 0.1 and 100");
  require_factor("support_factor", p.support_factor, 0.1, "between 0.1 and 100");
  require(std::isfinite(p.most_spacing) && p.most_spacing >= 0.0, "most_spacing", p.most_spacing,
          "finite and not negative");
  for (const double c : p.viewpoint) {
    if (!std::isfinite(c)) throw ConfigError("the viewpoint must be three finite coordinates");
  }
}

SegmentLengths segment_lengths(const SegmentPlane& plane, const Lattice& lattice, const SegmentContourParameters& p) {
  constexpr double kUnit = static_cast<double>(std::int64_t{1} << kFrameBits);
  SegmentLengths l;
  l.spacing = p.most_spacing > 0.0 ? std::min(plane.spacing, p.most_spacing / lattice.step) : plane.spacing;
  l.spacing = std::max(l.spacing, 1.0 / kUnit);  // Planes of nothing divide nothing by 0.
  l.two_alpha = std::floor(2.0 * p.alpha_factor * l.spacing * kUnit) / kUnit;
  const double alpha = 0.5 * l.two_alpha;
  l.slab = std::clamp(kSlabRms * plane.rms, alpha, kMostSlabAlphas * alpha);
  const double line = p.line_factor * l.spacing;
  l.line = std::clamp(kLineRms * plane.rms, line, kMostLine * line);
  l.explain = kExplain * line;
  l.support = p.support_factor * l.spacing;
  l.most_support = kSparser * l.support;
  double reach = 0.0;
  if (p.boundary || p.outlines) reach = std::sqrt(l.two_alpha * l.two_alpha + 4.0 * l.slab * l.slab);
  if (p.fold || p.boundary) reach = std::max(reach, l.explain + l.most_support);
  l.reach = reach * (1.0 + kFrameError);
  return l;
}

double segment_contour_halo(const SegmentContourParameters& parameters, std::span<const SegmentPlane> planes,
                            const Lattice& lattice) {
  validate(parameters);
  double reach = 0.0;
  for (const SegmentPlane& plane : planes) reach = std::max(reach, segment_lengths(plane, lattice, parameters).reach);
  if (!(reach <= kMostSteps)) {
    throw ConfigError(fmt::format(
        "the contours of segments look {:.3g} lattice steps of {} around each point, more than 2^26: choose a "
        "larger --lattice step",
        reach, lattice.step));
  }
  return reach * lattice.step;
}

}  // namespace arris
