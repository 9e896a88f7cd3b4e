#include <algorithm>
#include <cmath>

#include "core/columns.h"
#include "features/liu/liu_method.h"
#include "features/numerics/exact_math.h"

namespace arris {
namespace {

/// Local spacings scatter around the typical one; this covers nearly all of them.
constexpr double kHaloMargin = 1.25;
/// Balls that must agree on a fold point for a score of one half.
constexpr float kHalfVotes = 3.0F;

}  // namespace

double liu_halo(const LiuParameters& parameters, double spacing) {
  if (parameters.spacing > 0.0) spacing = parameters.spacing;
  double reach = spacing * std::sqrt(parameters.k_max / kPi);
  if (parameters.fold) {
    // Votes are combined over tiles, so that the ball around the query is all that must be seen.
    reach =
        std::max(reach, parameters.radius > 0.0 ? parameters.radius / kHaloMargin : parameters.radius_factor * spacing);
  }
  reach *= kHaloMargin;
  return parameters.max_radius > 0.0 ? std::min(reach, parameters.max_radius) : reach;
}

float liu_score(const ContourRecord& record, const LiuParameters& parameters) {
  float score = 0.0F;
  if (record.classes & (kBoundary | kWeakBoundary)) {
    const double beyond = (record.gap_deg - parameters.gap_deg) / (360.0 - parameters.gap_deg);
    const auto boundary = static_cast<float>(0.5 + 0.5 * std::clamp(beyond, 0.0, 1.0));
    score = (record.classes & kBoundary) ? boundary : 0.5F * boundary;
  }
  if (record.classes & kFold) {
    const auto votes = static_cast<float>(record.votes);
    score = std::max(score, votes / (votes + kHalfVotes));
  }
  return score;
}

}  // namespace arris
