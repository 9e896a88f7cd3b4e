#pragma once
/// @file How the memory budget is divided when points become voxels and voxels supervoxels.

#include <cstdint>

#include "features/supervoxel/supervoxel_parameters.h"
#include "tiling/survey.h"

namespace arris::pipeline {

/// The voxel table is freed before supervoxels grow, so each gets what the other leaves.
class VoxelMemory {
 public:
  /// Throws BudgetError if not even the least voxel table fits.
  explicit VoxelMemory(std::uint64_t budget_bytes);
  /// Of the table that sums points per voxel.
  std::uint64_t table_bytes() const { return table_bytes_; }
  /// Most that the index of all voxels may take.
  std::uint64_t index_bytes() const { return index_bytes_; }
  /// For the clustering, as things stand now: what is resident is deducted.
  std::uint64_t stage_bytes() const;
  /// What was resident so far is known by then.
  std::uint64_t predicted_peak_bytes(std::uint64_t stage_bytes) const;

 private:
  std::uint64_t usable_bytes_;
  std::uint64_t table_bytes_;
  std::uint64_t index_bytes_;
  mutable std::uint64_t before_stage_bytes_ = 0;
  mutable std::uint64_t peak_before_stage_bytes_ = 0;
};

/// About as many as there will be; for plans, before the voxels are known, as all below.
std::uint64_t likely_voxels(const tiling::Survey& survey, const SupervoxelScale& scale);

/// Peak of a run that writes labels only, without colours. @param budget_bytes  what does not fit is done in tiles.
std::uint64_t predicted_supervoxel_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                         const SupervoxelParameters& parameters, std::uint64_t budget_bytes);

/// How much is missing for so many bytes beside what is resident now; 0 if they fit.
std::uint64_t more_than_fits(std::uint64_t budget_bytes, std::uint64_t bytes);
/// The budget that leaves so much more than this one.
std::uint64_t raised_budget_bytes(std::uint64_t budget_bytes, std::uint64_t more_bytes);

/// What a SupervoxelScene and its table keep in memory.
std::uint64_t predicted_scene_bytes(const tiling::Survey& survey, const SupervoxelScale& scale);

/// Runs, store and normals of the voxels, without colours, for inputs whose neighbours in space are neighbours in the
/// file.
std::uint64_t predicted_voxel_temp_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                         const VoxelMemory& memory);

}  // namespace arris::pipeline
