#pragma once
/// @file The 26-neighbourhoods of voxels.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/voxel_tile.h"
#include "tiling/voxel_index.h"

namespace arris::tiling {

/// Where the neighbours of every so many blocks of a tile begin, and where the last end: 4 bytes for 256 blocks.
using LinkBegins = std::vector<std::uint32_t>;

/// Fills neighbour_begin and neighbours of `tile` from its keys. @param index  of exactly the tile's voxels.
/// Goes by groups of blocks: their voxels and those that touch them stand in a small cube (voxel_cube.h), where
/// neighbours lie at fixed offsets. Runs in parallel, and takes a few MB while it does.
/// @param begins  empty, and filled; or as the tile was linked before, so that nothing has to be counted.
void link_neighbours(VoxelTile& tile, const VoxelIndex& index, LinkBegins& begins);

/// Calls use(rank, ranks of its neighbours in ascending (dx, dy, dz)) for the voxels of blocks [begin, end), ascending.
/// Without links, which take memory: for those who look at neighbours once.
void for_each_neighbourhood(
    const VoxelIndex& index, std::size_t begin, std::size_t end,
    const std::function<void(std::uint32_t rank, std::span<const std::uint32_t> neighbours)>& use);

}  // namespace arris::tiling
