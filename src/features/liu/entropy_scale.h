#pragma once
/// @file The number of neighbours whose shape is clearest: the smallest entropy of the dimensional features (Liu et
/// al., eq. 1-6).

#include <cstddef>

#include "features/neighbourhood/nearest_select.h"
#include "features/numerics/symmetric_eigen3.h"

namespace arris {

/// Which neighbourhood sizes are compared, see LiuParameters.
struct ScaleRange {
  int k_min = 20;
  int k_max = 30;
  int k_step = 2;
  bool with_target = true;
  double min_planarity = 0.05;
};

/// Entropies closer than this are a tie, which the smaller k wins: exact planes have entropies that are equal but for
/// rounding.
constexpr double kEntropyTie = 1e-6;

struct ScaleChoice {
  int k = 0;                             ///< k_opt; 0 if there are fewer than k_min neighbours.
  SymmetricMatrix<double> covariance{};  ///< Of the chosen neighbourhood, times an irrelevant factor; steps².
  Eigenvalues<double> values{};          ///< Of the covariance.
};

/// Entropy of a1, a2, a3 (eq. 4, 5) for eigenvalues of any common scale; infinity if the largest is not positive.
template <class V>
V dimensional_entropy(const Eigenvalues<V>& values);

/// k = k_min, k_min + step, ... up to min(k_max, neighbours.count). O(k_max); eight sizes at a time.
ScaleChoice choose_scale(const Neighbours& neighbours, const ScaleRange& range);

}  // namespace arris
