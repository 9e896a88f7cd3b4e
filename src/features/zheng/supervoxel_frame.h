#pragma once
/// @file A frame in the plane of a supervoxel in which lattice positions have exact coordinates.

#include "features/numerics/symmetric_eigen3.h"
#include "features/supervoxel/supervoxel_table.h"

namespace arris {

/// u and v span the plane of the supervoxel, n is its normal. Law: the components are multiples of 2^-18, so that for
/// lattice differences of up to 2^33 steps per axis every dot product is exact in double, in any order: coordinates may
/// be taken relative to any origin and subtracted, the result depends on the two points only. The price: the frame is
/// orthonormal to 1e-5 only.
struct SupervoxelFrame {
  Vector3 u{0, 0, 0}, v{0, 0, 0}, n{0, 0, 0};
  bool defined = false;  ///< False if the supervoxel has no normal.
};

/// A function of the normal up to its sign: (u, v, n) and (u, -v, -n) are the same plane.
SupervoxelFrame supervoxel_frame(const SupervoxelTable& table, std::uint32_t label);

}  // namespace arris
