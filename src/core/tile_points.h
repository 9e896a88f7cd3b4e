#pragma once
/// @file The points of one tile as the methods see them.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/lattice.h"

namespace arris {

/// Unique positions of a tile's core and halo. Exact duplicates (same lattice position) are one entry whose id is the
/// smallest of theirs; the others are in `duplicates`. The order of entries has no meaning and no influence on results.
struct TilePoints {
  std::vector<LatticePoint> positions;
  std::vector<std::uint64_t> ids;  ///< Same length and order as positions.
  /// (id, index into positions) of every further point at a position that is already listed; any order.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> duplicates;
  LatticeBox core;     ///< Points inside are owned by this tile: only they are asked about.
  LatticeBox covered;  ///< Contains core. Every input point inside is present, so a support inside it is complete.
};

}  // namespace arris
