#pragma once
/// @file The points of one tile as the methods see them.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/lattice.h"
#include "core/pages.h"

namespace arris {

/// Of whole tiles: large, and soon to be the memory of something else.
using LatticePoints = PageVector<LatticePoint>;
using PointIds = PageVector<std::uint64_t>;

/// Unique positions of a tile's core and halo. Exact duplicates (same lattice position) are one entry whose id is the
/// smallest of theirs; the others are in `duplicates`. The order of entries has no meaning and no influence on results.
struct TilePoints {
  LatticePoints positions;
  PointIds ids;  ///< Same length and order as positions.
  /// (id, index into positions) of every further point at a position that is already listed; any order.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> duplicates;
  LatticeBox core;     ///< Points inside are owned by this tile: only they are asked about.
  LatticeBox covered;  ///< Contains core. Every input point inside is present, so a support inside it is complete.
};

}  // namespace arris
