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
/// one of smallest (D, cluster). Depends on the clusters of voxels around it. In parallel.
void attach_leftovers(const VoxelTile& tile, const VoxelFeatures& features, const Clusters& clusters,
                      const SupervoxelParameters& parameters, const SupervoxelScale& scale,
                      std::span<std::uint32_t> clusters_of);

/// What is left forms groups of its own: connected voxels of one seed cell. Returns the groups' voxels in the tile's
/// core, ascending ranks. Depends on the clusters of voxels in the same seed cell.
std::vector<OrphanVoxel> group_orphans(const VoxelTile& tile, const SupervoxelScale& scale,
                                       std::span<const std::uint32_t> clusters_of);

}  // namespace arris
