#pragma once
/// @file Zheng et al.'s method read literally, over all pairs of points: slow and plain.

#include <span>

#include "features/zheng/zheng_method.h"

namespace arris::test {

/// What extract_zheng must return for improved = false.
TileContours reference_zheng(const TilePoints& tile, std::span<const std::uint32_t> labels,
                             const SupervoxelTable& table, const Lattice& lattice, const ZhengParameters& parameters);

}  // namespace arris::test
