#pragma once
/// @file The precision-recall curve over the score of detections. Private to evaluate.

#include <span>

#include "evaluate/box_tree.h"
#include "evaluate/truth_samples.h"

namespace arris::evaluate {

/// One entry per detection in each span. Scores may be infinite, not NaN.
struct ScoredDetections {
  std::span<const Vec3> positions;
  std::span<const float> scores;
  std::span<const double> to_truth;
  std::span<const double> to_others;  ///< Detections with to_truth > limit >= to_others are left out.
};

/// Sum over falling thresholds of (gain in recall) * (precision there), without interpolation; 0 without detections.
/// Equal scores enter together, so the order of detections has no influence. @param tree  over positions.
/// @param limit  and the detections' distances are in units of the truth's edges.
double average_precision(const ScoredDetections& detections, const BoxTree& tree, const TruthSamples& truth,
                         double limit);

}  // namespace arris::evaluate
