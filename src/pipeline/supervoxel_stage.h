#pragma once
/// @file Clusters the voxels of a scan to supervoxels.

#include <cstdint>
#include <utility>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/supervoxel/point_refinement.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "pipeline/voxel_tile_walk.h"
#include "tiling/voxel_store.h"

namespace arris::pipeline {

struct SupervoxelStageRequest {
  TileWalkRequest walk;
  bool adjacency = false;  ///< Collect the pairs of neighbours.
};

struct SupervoxelStageResult {
  std::vector<std::uint32_t> ids;  ///< Per voxel by rank: 1 .. count, in the order in which ranks first meet them.
  std::uint32_t count = 0;
  std::uint32_t coarse = 0;  ///< Of them, those on coarser voxels.
  std::uint32_t groups = 0;  ///< Of them, those that grew from no seed.
  /// Pairs a < b of supervoxels with voxels among each other's 26 neighbours, ascending, once each; only if asked for.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> adjacency;
  std::vector<ClusterPlane> planes;   ///< By id; entry 0 is unused.
  std::vector<std::uint64_t> shared;  ///< A bit per voxel by rank: it touches a supervoxel of another surface.
  bool is_shared(std::uint32_t rank) const { return (shared[rank >> 6] >> (rank & 63) & 1) != 0; }
  std::uint64_t tiles = 0;
  std::uint64_t largest_tile_voxels = 0;
  std::uint64_t predicted_bytes = 0;  ///< Peak of what the stage keeps.
  std::uint64_t normals_bytes_on_disk = 0;
};

/// Supervoxels on the voxels given. Where points lie farther apart than those, no voxel touches another and no seed
/// finds enough of them: what is left over there is clustered again on voxels twice as large, and so on while a seed
/// cell is at least twice as wide as a voxel; the last leftovers form groups of connected voxels. Every voxel gets a
/// supervoxel. Depends on voxels and parameters only. Throws BudgetError if memory cannot do, IoError, Cancelled.
SupervoxelStageResult run_supervoxel_stage(const tiling::VoxelStore& store, const SupervoxelStageRequest& request,
                                           ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
