#pragma once
/// @file Planes of the windows of voxels around each voxel.

#include <array>
#include <limits>

#include "core/pages.h"
#include "core/voxel_tile.h"

namespace arris {

/// The least-squares plane of the centroids in a window, as seen from the centroid of its middle voxel; lengths in
/// voxel sides.
struct WindowPlane {
  std::array<float, 3> normal;  ///< Unit, with a positive component along a fixed generic direction; (0, 0, 0): none.
  float offset;                 ///< Of the plane along its normal.
  float misfit;  ///< Mean squared distance from the plane; of windows of one ring 4 times that. Infinite: no plane.
};
constexpr WindowPlane kNoPlane{{}, 0.0F, std::numeric_limits<float>::infinity()};

/// Windows that fit better than this count as flat.
constexpr float kFlatMisfit = 0.0025F;

/// The window of a voxel holds the two rings of voxels around it (neighbours of neighbours), each weighted by the
/// number of ways that lead to it, so that the middle counts most. Where that is not flat and one ring fits four times
/// better (on steps and bars that are hardly wider than a window), the window is one ring. No plane where fewer than
/// three voxels, or a line of them, define none. Depends on two rings. Runs in parallel; 20 bytes per voxel for the
/// result.
PageVector<WindowPlane> window_planes(const VoxelTile& tile);

/// From one voxel's centroid to another's, in voxel sides. @param per_side  1 / (fractions of a side).
inline std::array<float, 3> centroid_offset(const VoxelPosition& from, const VoxelPosition& to, float per_side) {
  return {static_cast<float>(difference(to[0], from[0])) * per_side,
          static_cast<float>(difference(to[1], from[1])) * per_side,
          static_cast<float>(difference(to[2], from[2])) * per_side};
}
inline float per_voxel_side(const VoxelTile& tile) {
  return 1.0F / (static_cast<float>(kVoxelFractions) * static_cast<float>(tile.grid.side_steps()));
}

}  // namespace arris
