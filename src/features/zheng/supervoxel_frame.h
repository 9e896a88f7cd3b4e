#pragma once
/// @file A frame in the plane of a supervoxel in which lattice positions have exact coordinates.

#include "features/planar/plane_frame.h"
#include "features/supervoxel/supervoxel_table.h"

namespace arris {

struct SupervoxelFrame : PlaneFrame {
  bool defined = false;  ///< False if the supervoxel has no normal.
};

SupervoxelFrame supervoxel_frame(const SupervoxelTable& table, std::uint32_t label);

}  // namespace arris
