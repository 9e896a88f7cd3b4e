#include "tiling/spacing.h"

#include <algorithm>
#include <cmath>

namespace arris::tiling {
namespace {

constexpr int kCoarsestLevel = 30;

/// Lower median over points of the count of their cell.
std::uint64_t median_count(std::span<const CellClass> classes, std::uint64_t points) {
  std::uint64_t below = 0;
  for (const CellClass& of : classes) {
    below += of.points * of.cells;
    if (below >= points - points / 2) return of.points;
  }
  return 0;
}

}  // namespace

double cell_spacing_steps(int level, std::uint64_t count) {
  const double side = std::ldexp(1.0, level);
  return std::clamp(side / std::sqrt(static_cast<double>(count)), 1.0, side);
}

SpacingEstimate estimate_spacing(const CellCounts& counts, std::span<const CellClass> classes,
                                 const LatticeBox& bounds) {
  if (counts.total() == 0) return {};
  std::uint64_t median = median_count(classes, counts.total());
  if (median >= kCoveredCellPoints) return {counts.level(), cell_spacing_steps(counts.level(), median)};
  // Each level works on a copy of the one before, which shrinks quickly.
  for (CellCounts coarse = counts.coarsened(counts.level() + 1);; coarse = coarse.coarsened(coarse.level() + 1)) {
    median = median_count(coarse.classes(), counts.total());
    if (median >= kCoveredCellPoints) return {coarse.level(), cell_spacing_steps(coarse.level(), median)};
    if (coarse.level() >= kCoarsestLevel) break;
  }
  std::int64_t longest = 1;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, bounds.max[axis] - bounds.min[axis]);
  const double steps = static_cast<double>(longest) / std::sqrt(static_cast<double>(counts.total()));
  return {-1, std::max(1.0, steps)};
}

}  // namespace arris::tiling
