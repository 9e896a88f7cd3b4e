#pragma once
/// @file Folds exact duplicates that already stand side by side.

#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "core/tile_points.h"

namespace arris::tiling {

/// Equal positions must be adjacent, with ascending ids. Fills positions, ids and duplicates of `tile`; O(n), no copy.
void fold_sorted(LatticePoints&& positions, PointIds&& ids, TilePoints& tile);

}  // namespace arris::tiling
