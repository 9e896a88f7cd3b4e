#pragma once
/// @file Normals of voxels.

#include <array>
#include <vector>

#include "core/voxel_tile.h"

namespace arris {

/// Least-squares plane of the centroids in the two rings of voxels around each voxel (neighbours of neighbours), each
/// weighted by the number of ways that lead to it, so that the middle counts most. Unit length, with n . g >= 0 for a
/// fixed direction g that hardly any surface is perpendicular to; (0, 0, 0) where fewer than three voxels, or a line of
/// them, define no plane. Bits depend on the voxels in two rings only. Right for voxels whose two rings are complete.
/// O(voxels * neighbours); 40 bytes per voxel while it works. Runs in parallel.
std::vector<std::array<float, 3>> voxel_normals(const VoxelTile& tile);

}  // namespace arris
