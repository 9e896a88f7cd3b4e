#pragma once
/// @file Seed voxels on absolute cells (Zheng et al. 2018, 2.1.2).

#include <cstdint>
#include <vector>

#include "core/voxel_tile.h"
#include "features/supervoxel/supervoxel_parameters.h"

namespace arris {

/// The seed cell that holds the middle of a voxel; cells are cubes of scale.seed_steps, centred on multiples of that.
LatticePoint seed_cell(const LatticePoint& voxel, const SupervoxelScale& scale);

struct Seed {
  LatticePoint cell;
  std::uint32_t voxel = 0;  ///< Index into the tile.
};

/// For every cell that holds voxels the one whose centroid is nearest to the middle of the cell (ties: the first in
/// Z-order), if it is in the tile's core and enough voxels can be reached from it, over neighbours, within R_search of
/// its centroid. Of two seeds nearer than R_seed / 3 in neighbouring cells (a noisy surface along the face between them
/// fills both) the one nearer to the middle of its cell stays. Ascending cells. Right if the tile covers every cell
/// that reaches into its core, the cells around those, and R_search around these.
std::vector<Seed> find_seeds(const VoxelTile& tile, const SupervoxelScale& scale);

}  // namespace arris
