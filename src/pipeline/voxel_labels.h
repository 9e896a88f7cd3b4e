#pragma once
/// @file The supervoxel of any point.

#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "pipeline/supervoxel_stage.h"
#include "tiling/voxel_store.h"

namespace arris::pipeline {

/// Points have the supervoxel of their voxel, or, where their voxel touches another surface, the one of the two whose
/// plane fits them (features/supervoxel/point_refinement.h). Refers to what it is made from. Not thread-safe; one per
/// thread. Faster for points that come in voxels or near each other.
class VoxelLabels {
 public:
  VoxelLabels(const tiling::VoxelStore& store, const SupervoxelStageResult& clusters)
      : store_(store), clusters_(clusters) {}

  /// Of each point (equal lengths); 0 where there is no voxel.
  void find(std::span<const LatticePoint> points, std::span<std::uint32_t> ids);

 private:
  std::uint32_t id_at(const LatticePoint& p, const LatticePoint& key, std::uint32_t rank) {
    if (rank == tiling::VoxelIndex::kNone) return 0;
    const std::uint32_t own = clusters_.ids[rank];
    return clusters_.shared.empty() || !clusters_.is_shared(rank) ? own : refine(p, key, rank, own);
  }
  std::uint32_t refine(const LatticePoint& p, const LatticePoint& key, std::uint32_t rank, std::uint32_t own);

  const tiling::VoxelStore& store_;
  const SupervoxelStageResult& clusters_;
  std::uint32_t hint_ = 0;
  std::uint32_t last_rank_ = tiling::VoxelIndex::kNone;
  std::vector<std::uint32_t> around_;  ///< Other supervoxels around the voxel asked for last.
};

}  // namespace arris::pipeline
