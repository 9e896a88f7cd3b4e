#pragma once
/// @file Supervoxels of points in voxels that two surfaces share: better than the paper, where points inherit the label
/// of their voxel.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/voxel_tile.h"
#include "features/supervoxel/clusters.h"

namespace arris {

/// The plane of a supervoxel: mean position and mean normal of its voxels.
struct ClusterPlane {
  VoxelPosition position{};
  std::array<float, 3> normal{};  ///< (0, 0, 0): none; such supervoxels neither win nor lose points.
};

/// Distance of a position from a plane, in fractions of a step; exact differences, fixed order.
inline float plane_distance(const ClusterPlane& plane, const VoxelPosition& at) {
  float sum = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum += static_cast<float>(difference(at[axis], plane.position[axis])) * plane.normal[axis];
  return sum < 0.0F ? -sum : sum;
}

/// True if the planes differ enough to share out points: by more than 10 degrees, or by an offset of a quarter of a
/// voxel as seen from either.
bool planes_differ(const ClusterPlane& a, const ClusterPlane& b, std::int32_t voxel_steps);

/// A point leaves its voxel's supervoxel only for one whose plane is nearer by this share of a voxel: noise must not
/// move points between supervoxels of one surface.
constexpr float kRefinementMargin = 0.125F;

/// The supervoxel of a point: `own`, or the one among `others` (ids of supervoxels around its voxel) whose plane is
/// nearest and nearer than that of `own` by the margin; ties: the smaller id.
std::uint32_t refined_label(std::span<const ClusterPlane> planes, std::uint32_t own,
                            std::span<const std::uint32_t> others, const VoxelPosition& at, std::int32_t voxel_steps);

}  // namespace arris
