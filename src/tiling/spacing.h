#pragma once
/// @file The spacing of points as the survey's counts tell it.

#include <span>

#include "core/lattice.h"
#include "tiling/cell_counts.h"

namespace arris::tiling {

/// A cell with at least this many points is taken to be covered by a surface, not cut by its rim.
constexpr std::uint64_t kCoveredCellPoints = 16;

struct SpacingEstimate {
  int level = -1;  ///< Level of the cells it was made from: the finest at which the median count is large enough; -1 if
                   ///< none is.
  double steps = 0.0;  ///< Spacing in lattice steps, >= 1; 0 if there are no points.
};

/// Median over points of cell side / sqrt(count of the cell), on the finest level from counts.level() on at which the
/// median over points of the count is at least kCoveredCellPoints. Clouds that reach this nowhere (a few dozen points,
/// a thousand if they straddle the origin): longest side of `bounds` / sqrt(points). Never below one step (duplicates).
/// Memory: 8 bytes per active cell, and a copy of the counts where coarser levels are needed.
/// @param classes  of counts.
SpacingEstimate estimate_spacing(const CellCounts& counts, std::span<const CellClass> classes,
                                 const LatticeBox& bounds);

/// Spacing in steps in a cell of 2^level steps that holds `count` >= 1 points; within [1, side].
double cell_spacing_steps(int level, std::uint64_t count);

}  // namespace arris::tiling
