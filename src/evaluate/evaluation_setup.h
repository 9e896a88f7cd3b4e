#pragma once
/// @file What an evaluation and the coverage of its input must agree on: spacing, tolerances, counted edges. Private to
/// evaluate.

#include <vector>

#include "evaluate/contour_evaluation.h"

namespace arris::evaluate {

/// Relative slack of comparisons with a tolerance: grid points often lie at exactly half a spacing from an edge, and
/// must not be judged by the last bit of a rounded coordinate.
constexpr double kToleranceSlack = 1e-6;

struct EvaluationSetup {
  double spacing = 0.0;
  double noise = 0.0;
  /// Ascending, unique; in units: data units, or local spacings.
  std::vector<double> tolerances;
  /// What distances to each counted edge and each other edge are measured in, data units: 1, or the edge's spacing.
  std::vector<double> units, other_units;
  bool local = false;              ///< Units are local spacings.
  std::vector<TruthEdge> counted;  ///< Edges of the kinds that count, in the truth's order.
  std::vector<TruthEdge> others;
};

enum class Judgement : std::uint8_t { kCounts, kMasked, kNonFinite, kBelowMinScore };

/// Whether a prediction is a detection.
Judgement judge(const PredictedPoint& prediction, const EvaluationOptions& options);

/// Half a spacing in units: the longest piece of the truth that recall is counted over.
inline double sample_step(const EvaluationSetup& setup) {
  return 0.5 * (setup.local ? 1.0 : setup.spacing);
}

/// Throws ConfigError.
EvaluationSetup prepare(const Truth& truth, const EvaluationOptions& options);

}  // namespace arris::evaluate
