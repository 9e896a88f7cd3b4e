#pragma once
/// @file How two supervoxels lie to each other.

#include "features/numerics/symmetric_eigen3.h"
#include "features/supervoxel/supervoxel_table.h"

namespace arris {

/// Unsigned angle between the normals, degrees, [0, 90]; 0 if one of them is undefined: what has no plane meets nothing
/// at an angle.
double normal_angle_deg(const SupervoxelTable& table, std::uint32_t a, std::uint32_t b);

/// How far the surfaces of two supervoxels are offset from each other along the mean of their normals, steps: the
/// height of a step between parallel planes; 0 for neighbouring patches of a sphere or cylinder, which lie below each
/// other's planes alike. 0 if a normal is undefined.
double step_height(const SupervoxelTable& table, std::uint32_t a, std::uint32_t b);

/// The interior angle, degrees, (0, 180), of the two half planes in which the supervoxels a and b meet at the position
/// `contact` (steps): each half plane starts at the line through the contact in which the planes cross and goes to the
/// side of its supervoxel's centroid. It is the angle between the normals, or 180 degrees minus it. 180 if the planes
/// are parallel or undefined.
double interior_angle_deg(const SupervoxelTable& table, std::uint32_t a, std::uint32_t b, const Vector3& contact);

}  // namespace arris
