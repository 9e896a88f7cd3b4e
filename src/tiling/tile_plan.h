#pragma once
/// @file Cuts space into tiles whose core and halo fit what the budget allows.

#include <cstdint>
#include <functional>
#include <vector>

#include "core/lattice.h"
#include "tiling/plan_cells.h"
#include "tiling/survey.h"

namespace arris::tiling {

struct PlannedTile {
  LatticeBox core;                   ///< Half-open; cores are disjoint and contain every point.
  LatticeBox covered;                ///< core expanded by the halo.
  std::uint64_t core_points = 0;     ///< Exact: a core is a union of cells (or empty space).
  std::uint64_t covered_points = 0;  ///< Upper bound: all cells that touch `covered`.
};

struct PlanRequest {
  std::uint64_t max_points =
      0;  ///< Most covered points of a tile, >= 1. May be exceeded only by a tile that is one cell.
  std::uint64_t max_core_points = 0;  ///< Most core points, likewise; 0: no such limit.
  /// Halo in data units that a method wants where the local spacing is at most `spacing` (data units).
  std::function<double(double spacing)> halo;
  double max_radius = 0.0;  ///< R_max in data units, > 0: no halo is wider.
  /// The halo is needed whole: queries cannot be asked again. Else it is narrowed where it would dominate a tile.
  bool whole_halo = false;
};

struct TilePlan {
  std::vector<PlannedTile> tiles;  ///< Non-empty cores only, in Morton-like order of the binary splits.
  std::uint64_t largest_covered_points = 0;
  double duplication = 1.0;  ///< Predicted (sum of covered points) / points.
};

/// Share of a tile's points whose local spacing the halo is made for; the others may have to be asked again with a
/// wider halo.
constexpr double kHaloQuantile = 0.95;

/// Binary splits of the whole lattice at midpoints of its octree, along the longest side of the occupied part (ties: x,
/// y, z), until a tile fits. Cells are those of the survey, the crowded ones refined. A core is the bounding box of its
/// occupied cells. The halo is request.halo of the kHaloQuantile of the local spacings over the core's points, capped
/// by max_radius, rounded up to at least one step.
///
/// Deterministic. Complexity O(cells * depth). Memory: about 85 bytes per cell while it works. Throws
/// ConfigError if the request is out of range. A tile of one cell is not cut further: largest_covered_points
/// tells whether the budget can be met.
TilePlan plan_tiles(const PlanCells& cells, const PlanRequest& request);
TilePlan plan_tiles(const Survey& survey, const PlanRequest& request);

}  // namespace arris::tiling
