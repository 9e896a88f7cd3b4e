#pragma once
/// @file Normals of voxels.

#include <array>

#include "core/pages.h"
#include "core/voxel_tile.h"

namespace arris {

/// A voxel's normal is that of its window (voxel_windows.h) if that is flat, else of the window, among those with their
/// middle in its own two rings, whose plane fits best: least scatter plus squared distance of the voxel from it. So the
/// normals beside a fold are those of the surfaces that meet there, and not a mixture (the idea of Kuwahara's filter,
/// 1976). Unit length, with n . g >= 0 for a fixed generic direction g; (0, 0, 0) where there is no plane. Depends on
/// four rings of voxels. O(voxels * neighbours); 28 bytes per voxel while it works. Runs in parallel.
PageVector<std::array<float, 3>> voxel_normals(const VoxelTile& tile);

}  // namespace arris
