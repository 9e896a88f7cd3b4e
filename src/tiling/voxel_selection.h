#pragma once
/// @file Finds the blocks of voxels that meet a box.

#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "tiling/voxel_index.h"

namespace arris::tiling {

/// The blocks of an index that may hold voxels of a box: ascending ranges with gaps between them. Skips what is outside
/// by halving cubes: O(ranges log(blocks)).
std::vector<BlockRange> select_blocks(const VoxelIndex& index, const LatticeBox& keys);

}  // namespace arris::tiling
