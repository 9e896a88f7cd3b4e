#include "tiling/cell_level.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "tiling/cell.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kBitsPerLeaf = 64;

}  // namespace

int level_that_fits(std::span<const LatticePoint> points, int first, std::size_t max_leaves) {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / std::max<std::size_t>(1, 4 * max_leaves));
  // A bit per hash: where two leaves have the same, they count as one. There are no more leaves than points.
  const std::size_t bits = std::bit_ceil(kBitsPerLeaf * (std::min(max_leaves, points.size()) + 1));
  const int shift = 64 - std::countr_zero(bits);
  std::vector<bool> met;
  const auto fits = [&](int level) {
    met.assign(bits, false);
    std::size_t leaves = 0;
    for (std::size_t i = 0; i < points.size() && leaves <= max_leaves; i += stride) {
      const Cell leaf = cell_of(points[i], std::min(level + kCellLeafLog2, 31));
      std::uint64_t hash = 0;
      for (const std::int32_t c : leaf) hash = (hash ^ static_cast<std::uint32_t>(c)) * 0x9E3779B97F4A7C15U;
      auto bit = met[hash >> shift];
      leaves += !bit;
      bit = true;
    }
    return leaves <= max_leaves;
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
