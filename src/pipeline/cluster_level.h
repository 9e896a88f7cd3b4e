#pragma once
/// @file Supervoxels on voxels of one size.

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "features/supervoxel/point_refinement.h"
#include "pipeline/voxel_tile_walk.h"

namespace arris::pipeline {

/// Bytes of a cluster in all tables, for predictions before the clusters are known.
double cluster_bytes(const SupervoxelParameters& parameters);
/// @param voxels  that have others near.
double likely_clusters(double voxels, const SupervoxelScale& scale);

struct ClusterLevel {
  std::vector<std::uint32_t> clusters_of;  ///< Per voxel by rank: below `count`, or kNoCluster.
  std::uint32_t count = 0;
  std::vector<ClusterPlane> planes;       ///< Per cluster that could grow from its seed; no plane for the others.
  std::vector<std::uint32_t> seed_ranks;  ///< Likewise.
  std::uint32_t lone = 0;                 ///< Clusters of a seed without neighbours; they come next.
  std::uint32_t groups = 0;               ///< Clusters without a seed; the last ones.
  std::uint64_t predicted_bytes = 0;      ///< Peak of what is kept and of tiles.
};

/// Passes over tiles of voxels: seeds; per iteration growth with sums, then new seeds; growth of the last iteration,
/// whose leftovers join what they touch. Tiles see scale.halo_voxels() around their core in each pass, and what goes
/// from one pass to the next is global (merge/cluster_table.h), so the tiles cannot matter.
/// @param group_leftovers  what is still left becomes groups of connected voxels; else it stays without cluster.
/// @param kept_bytes       memory that the caller holds beside this.
ClusterLevel cluster_level(VoxelTileWalk& walk, bool group_leftovers, std::uint64_t kept_bytes, ProgressSink& progress);

}  // namespace arris::pipeline
