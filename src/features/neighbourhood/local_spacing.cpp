#include "features/neighbourhood/local_spacing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

constexpr std::size_t kNearest = 6;

/// weight[j] = sqrt(pi / (j + 1)) of neighbour j.
struct Weights {
  double at[simd::padded(256)];
  Weights() {
    for (std::size_t j = 0; j < std::size(at); ++j) at[j] = std::sqrt(kPi / static_cast<double>(j + 1));
  }
};
const Weights kWeights;

constexpr std::size_t kParts = 4;

/// The distances of the nearest neighbours; and sums over neighbours [first, n) in kParts interleaved parts, neighbour
/// j in part j % kParts.
struct Sums {
  double roots[simd::kPadding];
  double parts[kParts];
};

struct Kernel {
  /// Reads up to simd::padded(n).
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const double* d2, const double* weights, std::size_t first, std::size_t n,
                                      Sums& sums) {
    using V = typename simd::Wide<Bytes>::Double;
    using Parts = typename simd::Wide<kParts * sizeof(double)>::Double;
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
    for (std::size_t j = aligned; j < end; j += kParts) parts += simd::load<Parts>(terms + j);
    simd::store(sums.parts, parts);
  }
};

Sums sums_of(const double* d2, std::size_t n) {
  Sums sums;
  simd::dispatch<Kernel>(d2, kWeights.at, n / 2, n, sums);
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

double density_spacing(const double* d2, std::size_t n) {
  return density_of(sums_of(d2, n), n);
}

}  // namespace arris
