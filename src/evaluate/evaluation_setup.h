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
  std::vector<double> tolerances;  ///< Ascending, unique, data units.
  std::vector<TruthEdge> counted;  ///< Edges of the kinds that count, in the truth's order.
  std::vector<TruthEdge> others;
};

/// Throws ConfigError.
EvaluationSetup prepare(const Truth& truth, const EvaluationOptions& options);

}  // namespace arris::evaluate
