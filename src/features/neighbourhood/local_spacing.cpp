#include "features/neighbourhood/local_spacing.h"

#include <algorithm>
#include <cmath>

#include "features/neighbourhood/density_weights.h"

namespace arris {
namespace {

constexpr std::size_t kNearest = 6;

/// The distances of the nearest neighbours; and sums over neighbours [first, n) in kDensityParts interleaved parts,
/// neighbour j in part j % kDensityParts.
struct Sums {
  double roots[simd::kPadding];
  double parts[kDensityParts];
};

struct Kernel {
  /// Reads up to simd::padded(n).
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const double* d2, const double* weights, std::size_t first, std::size_t n,
                                      Sums& sums) {
    using V = typename simd::Wide<Bytes>::Double;
    using Parts = typename simd::Wide<kDensityParts * sizeof(double)>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    for (std::size_t j = 0; j < kNearest; j += kLanes) {
      simd::store(sums.roots + j, simd::square_root(simd::load<V>(d2 + j)));
    }
    double terms[simd::padded(256)];
    const std::size_t aligned = first / 8 * 8;
    const std::size_t end = simd::padded(n);
    for (std::size_t j = aligned; j < end; j += kLanes) {
      simd::store(terms + j, simd::square_root(simd::load<V>(d2 + j)) * simd::load<V>(weights + j));
    }
    for (std::size_t j = aligned; j < first; ++j) terms[j] = 0.0;  // Adds nothing.
    for (std::size_t j = n; j < end; ++j) terms[j] = 0.0;
    Parts parts{};
    for (std::size_t j = aligned; j < end; j += kDensityParts) parts += simd::load<Parts>(terms + j);
    simd::store(sums.parts, parts);
  }
};

Sums sums_of(const double* d2, std::size_t n) {
  Sums sums;
  simd::dispatch<Kernel>(d2, kDensityWeights.at, n / 2, n, sums);
  return sums;
}

double density_of(const Sums& sums, std::size_t n) {
  return ((sums.parts[0] + sums.parts[1]) + (sums.parts[2] + sums.parts[3])) / static_cast<double>(n - n / 2);
}

}  // namespace

LocalSpacing local_spacing(const Neighbours& neighbours) {
  LocalSpacing spacing;
  const std::size_t n = neighbours.count;
  if (n == 0) return spacing;
  const std::size_t nearest = std::min(n, kNearest);
  const Sums sums = sums_of(neighbours.d2.data(), n);
  for (std::size_t j = 0; j < nearest; ++j) spacing.nearest += sums.roots[j];
  spacing.nearest /= static_cast<double>(nearest);
  spacing.density = density_of(sums, n);
  return spacing;
}

}  // namespace arris
