#pragma once
/// @file Flow-constrained growth of supervoxels from their seeds, level by level (Papon et al. 2013; Zheng et al. 2018,
/// 2.1.4), free of any order.

#include <cstdint>
#include <span>
#include <vector>

#include "core/pages.h"
#include "features/supervoxel/clusters.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "features/supervoxel/voxel_features.h"

namespace arris {

/// A cluster and the voxel of the tile that it grows from.
struct TileSeed {
  std::uint32_t voxel = 0;
  std::uint32_t cluster = 0;
};

/// The cluster of each voxel of the tile after `scale.levels` levels, kNoCluster where none came. At every level each
/// cluster offers the voxels around those it won at the level before its distance D to them; a voxel goes to the
/// smallest (D, cluster) that it was ever offered. A seed's voxel stays with it. Centres do not move meanwhile.
///
/// Laws: (1) the result depends on voxels, seeds and centres only: of the offers of a level the smallest wins, in
/// whatever order they come; (2) the cluster of a voxel depends on nothing that lies more than scale.levels voxels away
/// (Chebyshev), the features' own rings aside. O(voxels * neighbours * small factor). 9 bytes per voxel and the
/// frontiers. Runs in parallel.
PageVector<std::uint32_t> grow_clusters(const VoxelTile& tile, const VoxelFeatures& features, const Clusters& clusters,
                                        std::span<const TileSeed> seeds, const SupervoxelParameters& parameters,
                                        const SupervoxelScale& scale);

/// Seeds of clusters that lie in the tile. @param by_rank  indices of all clusters in ascending order of seed_ranks.
std::vector<TileSeed> tile_seeds(const VoxelTile& tile, const Clusters& clusters,
                                 std::span<const std::uint32_t> by_rank);

}  // namespace arris
