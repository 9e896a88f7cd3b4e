#pragma once
/// @file The 26-neighbourhoods of all voxels of a tile.

#include "core/voxel_tile.h"
#include "tiling/voxel_index.h"

namespace arris::tiling {

/// Fills neighbour_begin and neighbours of `tile` from its keys. @param index  of exactly the tile's voxels.
/// Goes block by block: the voxels of a block and those that touch it stand in a small cube, where neighbours lie at
/// fixed offsets. Runs in parallel, and takes a few MB while it does.
void link_neighbours(VoxelTile& tile, const VoxelIndex& index);

}  // namespace arris::tiling
