#pragma once
/// @file Cells that points are counted in.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/lattice.h"

namespace arris::tiling {

/// Of one level: 2^level steps long, at multiples of that.
using Cell = std::array<std::int32_t, 3>;

constexpr int kMaxCellLevel = 30;  ///< The coarsest.
constexpr int kCellLeafLog2 = 3;   ///< Cells along a side of a leaf, which is what memory is taken for.

inline LatticeBox cell_box(const Cell& cell, int level) {
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::int64_t{cell[axis]} * (std::int64_t{1} << level);
    box.max[axis] = box.min[axis] + (std::int64_t{1} << level);
  }
  return box;
}

inline Cell cell_of(const LatticePoint& p, int level) {
  return {p.x >> level, p.y >> level, p.z >> level};
}

/// The cell of a level coarser by `levels` that it lies in.
inline Cell cell_coarsened(const Cell& cell, int levels) {
  return {cell[0] >> levels, cell[1] >> levels, cell[2] >> levels};
}

inline bool same_cell(const LatticePoint& a, const LatticePoint& b, int level) {
  return static_cast<std::uint32_t>((a.x ^ b.x) | (a.y ^ b.y) | (a.z ^ b.z)) >> level == 0;
}

/// Where the run of points of the same cell ends that starts at `begin`: scans mostly stay in a cell for a while.
inline std::size_t end_of_run(std::span<const LatticePoint> points, std::size_t begin, int level) {
  std::size_t end = begin + 1;
  while (end < points.size() && same_cell(points[end], points[begin], level)) ++end;
  return end;
}

}  // namespace arris::tiling
