#pragma once
/// @file Voxels that no seed reached.

#include <cstdint>
#include <span>
#include <vector>

#include "features/supervoxel/clusters.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "features/supervoxel/voxel_features.h"

namespace arris {

/// A voxel and the smallest rank of the leftover group that it belongs to.
struct OrphanVoxel {
  std::uint32_t rank = 0;
  std::uint32_t root_rank = 0;
};

/// Attaches each voxel without cluster that touches clusters (among its 26 neighbours, as `clusters_of` came in) to the
/// one of smallest (D, cluster). What is left forms groups of its own: connected voxels of one seed cell. `clusters_of`
/// gets what was attached; the groups' voxels in the tile's core are returned, ascending ranks.
/// Depends on the clusters of voxels in the same seed cell and one voxel around it.
std::vector<OrphanVoxel> settle_leftovers(const VoxelTile& tile, const VoxelFeatures& features,
                                          const Clusters& clusters, const SupervoxelParameters& parameters,
                                          const SupervoxelScale& scale, std::span<std::uint32_t> clusters_of);

}  // namespace arris
