#include "tiling/cell_level.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tiling/cell_tree.h"

namespace arris::tiling {

int level_that_fits(std::span<const LatticePoint> points, int first, std::size_t max_leaves) {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / std::max<std::size_t>(1, 4 * max_leaves));
  std::vector<std::uint64_t> hashes;
  const auto fits = [&](int level) {
    hashes.clear();
    for (std::size_t i = 0; i < points.size(); i += stride) {
      const Cell leaf = cell_of(points[i], std::min(level + kCellLeafLog2, 31));
      std::uint64_t hash = 0;
      for (const std::int32_t c : leaf) hash = (hash ^ static_cast<std::uint32_t>(c)) * 0x9E3779B97F4A7C15U;
      if (hashes.empty() || hash != hashes.back()) hashes.push_back(hash);
    }
    if (hashes.size() <= max_leaves) return true;
    std::ranges::sort(hashes);
    return static_cast<std::size_t>(std::ranges::unique(hashes).begin() - hashes.begin()) <= max_leaves;
  };
  int low = first, high = kMaxCellLevel;  // The level lies in [low, high].
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (fits(middle)) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

}  // namespace arris::tiling
