#pragma once
/// @file The number of neighbours whose shape is clearest: the smallest entropy of the dimensional features (Liu et
/// al., eq. 1-6).

#include <cstddef>
#include <limits>

#include "features/neighbourhood/nearest_select.h"
#include "features/numerics/exact_math.h"
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

/// One term of an entropy, in float: far more exact than a tie needs, in a fraction of the time.
template <class V>
ARRIS_ALWAYS_INLINE typename simd::Narrow<V>::Float entropy_term(const V& a) {
  using Float = typename simd::Narrow<V>::Float;
  const V positive = a > 1e-30 ? a : a - a + 1e-30;  // 0 ln 0 = 0.
  const Float narrow = simd::convert<Float>(positive);
  return narrow * short_log_of_positive<V>(narrow);
}

/// Entropy of a1, a2, a3 (eq. 4, 5) for eigenvalues of any common scale; infinity if the largest is not positive; error
/// below 3e-7. One query or, with vectors of doubles, many.
template <class V>
ARRIS_ALWAYS_INLINE V entropy_of(const Eigenvalues<V>& values) {
  const V zero = values.largest - values.largest;
  const V l1 = values.largest > 0.0 ? values.largest : zero + 1.0;
  const V d1 = simd::square_root(l1);
  const V d2 = simd::square_root(values.middle > 0.0 ? values.middle : zero);
  const V d3 = simd::square_root(values.smallest > 0.0 ? values.smallest : zero);
  const V inverse = 1.0 / d1;
  const V a1 = (d1 - d2) * inverse;
  const V a2 = (d2 - d3) * inverse;
  const V a3 = d3 * inverse;
  const V entropy = -simd::convert<V>(entropy_term(a1) + entropy_term(a2) + entropy_term(a3));
  return values.largest > 0.0 ? entropy : zero + std::numeric_limits<double>::infinity();
}

}  // namespace arris
