#pragma once
/// @file Intensities without their noise.

#include <cstdint>
#include <span>

#include "core/pages.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {

/// Every point that has a shape gets the median of its own intensity and its neighbours' (of an even number the upper
/// one): noise goes, the borders of materials stay where they are. Per slot of the tree. Runs in parallel.
PageVector<std::uint8_t> smoothed_intensities(const TileNeighbourhoods& points,
                                              std::span<const std::uint8_t> intensities);

}  // namespace arris
