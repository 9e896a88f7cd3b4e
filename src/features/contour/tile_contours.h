#pragma once
/// @file What a method returns for one tile.

#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "features/contour/contour_record.h"

namespace arris {

/// A query whose support could not be proven to lie inside TilePoints::covered. Running it again on points that cover
/// the ball of `reach_steps` around `position` proves it, or (region growing) tells a greater reach that will.
struct UnprovenQuery {
  std::uint64_t id = 0;
  LatticePoint position;
  std::int64_t reach_steps = 0;       ///< The ball of this radius must be covered.
  std::int64_t most_reach_steps = 0;  ///< Region growing: no greater reach will ever be told; 0: not known.
};

/// An entry of a tile to ask about, of which space is known so far around it.
struct PlacedQuery {
  std::uint32_t entry = 0;
  std::int64_t reach_steps = 0;  ///< The ball of this radius is covered.
};

struct TileContours {
  /// Records of contour points only; at most one per id, ascending ids. Votes may concern any point in a ball, owned by
  /// this tile or not; all else concerns queried points. Duplicates are expanded: every id at a contour position has
  /// its record.
  ContourRecords records;
  std::vector<UnprovenQuery> unproven;  ///< Ascending ids. They left no trace in `records` and `isolated`.
  std::uint64_t isolated = 0;           ///< Queried points with too few neighbours within R_max (duplicates count).
};

}  // namespace arris
