#pragma once
/// @file arris's own method: boundary and fold points of one tile (docs/methods-arris.md). Pure: no I/O, no state
/// between calls.

#include <cstdint>
#include <span>

#include "core/lattice.h"
#include "core/tile_points.h"
#include "features/arris/arris_parameters.h"
#include "features/contour/tile_contours.h"

namespace arris {

/// Runs the method for every core point of the tile (or, if `queries` is given, for those indices of tile.positions
/// only). Each point is judged by itself, from the points within at most 13 local spacings of it: so a record concerns
/// a queried point, and results of proven queries depend on the input points and the parameters only, not on tile.core,
/// tile.covered, the order of entries or the number of threads. Runs in parallel (core/parallel.h). Memory beyond the
/// tile: kArrisBytesPerPoint, kArrisBytesPerThread. Points with fewer than 20 neighbours within R_max are isolated, and
/// no contour. Throws ConfigError if a parameter is out of range, or if R_max is more than 2^30 lattice steps.
/// Complexity: O(n log n) for the tree, then about the points within the supports. Source: Liu et al. (local
/// projection, azimuth gaps, folds as two lines) with robust planes, bending arms and noise-adaptive radii.
TileContours extract_arris(const TilePoints& tile, const Lattice& lattice, const ArrisParameters& parameters);
TileContours extract_arris(const TilePoints& tile, const Lattice& lattice, const ArrisParameters& parameters,
                           std::span<const std::uint32_t> queries);

/// Bytes beyond the tile itself, for predictions. Per position: the search tree, and 48 per returned record, of which
/// scans have one in three positions at most. Per thread: scratch memory.
constexpr double kArrisBytesPerPoint = 56.0;
constexpr double kArrisBytesPerThread = 8.0 * 1024 * 1024;

/// A halo, in data units, that proves nearly all queries where the spacing is at most `spacing`.
double arris_halo(const ArrisParameters& parameters, double spacing);

}  // namespace arris
