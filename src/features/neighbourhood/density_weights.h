#pragma once
/// @file What the density spacing makes of distances.

#include <cmath>
#include <cstddef>
#include <iterator>

#include "features/numerics/exact_math.h"
#include "features/numerics/simd.h"

namespace arris {

/// at[j] = sqrt(pi / (j + 1)), which makes a spacing of the distance of neighbour j.
struct DensityWeights {
  double at[simd::padded(256)];
  DensityWeights() {
    for (std::size_t j = 0; j < std::size(at); ++j) at[j] = std::sqrt(kPi / static_cast<double>(j + 1));
  }
};
inline const DensityWeights kDensityWeights;

/// Neighbour j is added to part j % kDensityParts, and the parts as (0 + 1) + (2 + 3), so that vectors can do it.
constexpr std::size_t kDensityParts = 4;

}  // namespace arris
