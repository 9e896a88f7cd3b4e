#pragma once
/// @file Liu et al., boundary and fold points, on the points of one tile. Pure: no I/O, no state between calls.

#include <cstdint>
#include <span>

#include "core/lattice.h"
#include "core/tile_points.h"
#include "features/contour/tile_contours.h"
#include "features/liu/liu_parameters.h"

namespace arris {

/// Runs the method for every core point of the tile (or, if `queries` is given, for those indices of tile.positions
/// only). Results of proven queries depend on the input points and the parameters only, not on tile.core, tile.covered,
/// the order of entries or the number of threads. Runs in parallel (core/parallel.h). Memory beyond the tile: see
/// liu_bytes_per_point. Throws ConfigError if a parameter is out of range, or if R_max is more than 2^30 lattice steps.
/// A ball or k-th distance that just reaches the limit of `covered` is unproven, not wrong. Complexity: O(n log n) for
/// the tree, then about the points within the supports. Source: Liu et al., eq. 1-24, read as docs/methods-liu.md says.
TileContours extract_liu(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters);
TileContours extract_liu(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters,
                         std::span<const std::uint32_t> queries);

/// Bytes that extract_liu needs beyond the tile itself, for predictions. Per position: 43 for the search tree and the
/// dense results, and 32 per returned record, of which scans have one in three positions at most. Per thread: scratch
/// memory, which grows by about 200 bytes per member if a fixed ball radius makes balls of more than 20 000 points.
constexpr double kLiuBytesPerPoint = 56.0;
constexpr double kLiuBytesPerThread = 4.0 * 1024 * 1024;

/// A halo, in data units, that proves nearly all queries where the spacing is at most `spacing`.
double liu_halo(const LiuParameters& parameters, double spacing);

/// EdgeScore in [0, 1] of a combined record: the larger of what its two kinds of evidence say. Boundary: 0.5 at the gap
/// threshold, rising linearly to 1 at a full turn; weak boundary: half of that. Fold: votes / (votes + 3).
float liu_score(const ContourRecord& record, const LiuParameters& parameters);

}  // namespace arris
