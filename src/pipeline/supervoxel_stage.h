#pragma once
/// @file Clusters the voxels of a scan to supervoxels, tile by tile.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/point_refinement.h"
#include "features/supervoxel_parameters.h"
#include "tiling/voxel_store.h"

namespace arris::pipeline {

struct SupervoxelStageRequest {
  SupervoxelParameters parameters;  ///< Resolved.
  SupervoxelScale scale;
  bool colours = false;
  std::uint64_t memory_bytes = 0;     ///< For everything that this stage keeps, the voxels' index excluded.
  std::uint64_t tile_voxels_cap = 0;  ///< 0: none.
  bool adjacency = false;             ///< Collect the pairs of neighbours.
  bool refine = true;                 ///< Find the voxels that several surfaces share.
};

struct SupervoxelStageResult {
  std::vector<std::uint32_t> ids;  ///< Per voxel by rank: 1 .. count, in the order in which ranks first meet them.
  std::uint32_t count = 0;
  std::uint32_t orphans = 0;  ///< Supervoxels that grew from no seed.
  /// Pairs a < b of supervoxels with voxels among each other's 26 neighbours, ascending, once each; only if asked for.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> adjacency;
  std::vector<ClusterPlane> planes;   ///< By id; entry 0 is unused.
  std::vector<std::uint64_t> shared;  ///< A bit per voxel by rank: it touches a supervoxel of another surface.
  bool is_shared(std::uint32_t rank) const { return (shared[rank >> 6] >> (rank & 63) & 1) != 0; }
  std::uint64_t tiles = 0;
  std::uint64_t largest_tile_voxels = 0;
  std::uint64_t predicted_bytes = 0;  ///< Peak of what the stage keeps.
};

/// Passes over tiles of voxels: seeds; per iteration growth with sums, then new seeds; growth of the last iteration
/// with leftovers; adjacency. Tiles see scale.halo_voxels() around their core in each pass, and what passes from one to
/// the next is global (ClusterTable), so the tiles cannot matter. A lone tile stays in memory between passes. Throws
/// BudgetError with the least budget if memory cannot do, IoError, Cancelled.
SupervoxelStageResult run_supervoxel_stage(const tiling::VoxelStore& store, const SupervoxelStageRequest& request,
                                           ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
