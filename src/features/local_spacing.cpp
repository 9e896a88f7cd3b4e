#include "features/local_spacing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "features/exact_math.h"

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

/// Sums over neighbours [first, n), in lanes that depend on j alone.
ARRIS_SIMD_CLONES double weighted_sum(const double* d2, std::size_t first, std::size_t n) {
  using simd::Double8;
  Double8 sum{};
  for (std::size_t j = first / 8 * 8; j < n; j += 8) {
    const Double8 terms = simd::square_root(simd::load<Double8>(d2 + j)) * simd::load<Double8>(kWeights.at + j);
    simd::Long8 index;
    for (std::size_t lane = 0; lane < 8; ++lane) index[lane] = static_cast<std::int64_t>(j + lane);
    const auto inside = (index >= static_cast<std::int64_t>(first)) & (index < static_cast<std::int64_t>(n));
    sum = inside ? sum + terms : sum;
  }
  double total = 0.0;
  for (std::size_t lane = 0; lane < 8; ++lane) total += sum[lane];
  return total;
}

}  // namespace

LocalSpacing local_spacing(const Neighbours& neighbours) {
  LocalSpacing spacing;
  const std::size_t n = neighbours.count;
  if (n == 0) return spacing;
  const std::size_t nearest = std::min(n, kNearest);
  for (std::size_t j = 0; j < nearest; ++j) spacing.nearest += std::sqrt(neighbours.d2[j]);
  spacing.nearest /= static_cast<double>(nearest);
  const std::size_t first = n / 2;
  spacing.density = weighted_sum(neighbours.d2.data(), first, n) / static_cast<double>(n - first);
  return spacing;
}

}  // namespace arris
