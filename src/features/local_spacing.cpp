#include "features/local_spacing.h"

#include <algorithm>
#include <cmath>

#include "features/exact_math.h"

namespace arris {

LocalSpacing local_spacing(const Neighbours& neighbours) {
  LocalSpacing spacing;
  const std::size_t n = neighbours.count;
  if (n == 0) return spacing;
  const std::size_t nearest = std::min<std::size_t>(n, 6);
  for (std::size_t j = 0; j < nearest; ++j) spacing.nearest += std::sqrt(neighbours.d2[j]);
  spacing.nearest /= static_cast<double>(nearest);
  const std::size_t first = n / 2;
  for (std::size_t j = first; j < n; ++j) spacing.density += std::sqrt(neighbours.d2[j] * (kPi / static_cast<double>(j + 1)));
  spacing.density /= static_cast<double>(n - first);
  return spacing;
}

}  // namespace arris
