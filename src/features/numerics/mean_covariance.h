#pragma once
/// @file Mean and covariance of points from their sums.

#include "features/numerics/symmetric_eigen3.h"

namespace arris {

/// Of one set or, with vectors of doubles, of many.
template <class V>
struct MeanCovariance {
  V x, y, z;
  SymmetricMatrix<V> covariance;
};
/// @param sums  n > 0, x, y, z, xx, xy, xz, yy, yz, zz.
template <class V>
ARRIS_ALWAYS_INLINE MeanCovariance<V> mean_covariance(const V (&sums)[10]) {
  const auto& [n, x, y, z, xx, xy, xz, yy, yz, zz] = sums;
  const V inverse = 1.0 / n;
  const V mx = x * inverse, my = y * inverse, mz = z * inverse;
  return {mx,
          my,
          mz,
          {xx * inverse - mx * mx, xy * inverse - mx * my, xz * inverse - mx * mz, yy * inverse - my * my,
           yz * inverse - my * mz, zz * inverse - mz * mz}};
}

}  // namespace arris
