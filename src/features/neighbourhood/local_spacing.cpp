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

struct Terms {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const double* d2, const double* weights, std::size_t n, double* terms) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t j = 0; j < n; j += Bytes / sizeof(double)) {
      const V term = simd::square_root(simd::load<V>(d2 + j)) * simd::load<V>(weights + j);
      simd::store(terms + j, term);
    }
  }
};

/// Sum over neighbours [first, n) in four interleaved parts.
double weighted_sum(const double* d2, std::size_t first, std::size_t n) {
  double terms[simd::padded(256)];
  const std::size_t aligned = first / 8 * 8;
  simd::dispatch<Terms>(d2 + aligned, kWeights.at + aligned, n - aligned, terms);
  double parts[4] = {};
  for (std::size_t j = first; j < n; ++j) parts[j % 4] += terms[j - aligned];
  return (parts[0] + parts[1]) + (parts[2] + parts[3]);
}

}  // namespace

LocalSpacing local_spacing(const Neighbours& neighbours) {
  LocalSpacing spacing;
  const std::size_t n = neighbours.count;
  if (n == 0) return spacing;
  const std::size_t nearest = std::min(n, kNearest);
  for (std::size_t j = 0; j < nearest; ++j) spacing.nearest += std::sqrt(neighbours.d2[j]);
  spacing.nearest /= static_cast<double>(nearest);
  spacing.density = density_spacing(neighbours.d2.data(), n);
  return spacing;
}

double density_spacing(const double* d2, std::size_t n) {
  const std::size_t first = n / 2;
  return weighted_sum(d2, first, n) / static_cast<double>(n - first);
}

}  // namespace arris
