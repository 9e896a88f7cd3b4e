#pragma once
/// @file Which points of a tile can grow.

#include <cstdint>

#include "core/pages.h"
#include "features/segment/likeness.h"
#include "features/segment/query_rings.h"
#include "features/segment/segment_parameters.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {

/// Per slot, 1 or 0; asked of queries and their neighbours only, 0 elsewhere. In parallel.
PageVector<std::uint8_t> growing_points(const TileNeighbourhoods& points, const QueryRings& rings,
                                        const Likeness& likeness, const SegmentParameters& parameters);

}  // namespace arris
