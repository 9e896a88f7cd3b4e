#pragma once
/// @file Normals of voxels.

#include <array>
#include <vector>

#include "core/voxel_tile.h"

namespace arris {

/// The window of a voxel holds the two rings of voxels around it (neighbours of neighbours), each weighted by the
/// number of ways that lead to it, so that the middle counts most; its plane is the least-squares plane of their
/// centroids. A voxel's normal is that of the window, among those with their middle in its own two rings, whose plane
/// fits best: least scatter plus squared distance of the voxel from it. So the normals beside a fold are those of the
/// surfaces that meet there, and not a mixture (the idea of Kuwahara's filter, 1976). Unit length, with n . g >= 0 for
/// a fixed direction g that hardly any surface is perpendicular to; (0, 0, 0) where fewer than three voxels, or a line
/// of them, define no plane. Depends on four rings of voxels. O(voxels * neighbours); 40 bytes per voxel while it
/// works. Runs in parallel.
std::vector<std::array<float, 3>> voxel_normals(const VoxelTile& tile);

}  // namespace arris
