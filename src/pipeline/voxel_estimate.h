#pragma once
/// @file What the survey's counts foretell of voxels and supervoxels; for plans, before the voxels are known.

#include <cstdint>

#include "features/supervoxel/supervoxel_parameters.h"
#include "pipeline/voxel_memory.h"
#include "tiling/survey.h"

namespace arris::pipeline {

struct VoxelEstimate {
  double voxels = 0.0;
  double blocks = 0.0;    ///< Of their index.
  double clusters = 0.0;  ///< Those with voxels that touch each other.
  double index_bytes = 0.0;

  double lone() const;  ///< lone_voxels().
};

/// The points of a cell fill what voxels a surface through it crosses. Within a tenth on towns of any density.
VoxelEstimate estimate_voxels(const tiling::Survey& survey, const SupervoxelScale& scale);

/// Their voxels alone.
double likely_voxels(const tiling::Survey& survey, const SupervoxelScale& scale);

/// What comes on top of what is resident, at its peak.
struct SupervoxelBytes {
  std::uint64_t counting = 0;  ///< While voxels are counted.
  std::uint64_t growing = 0;   ///< While clusters grow.
};
/// @param resident_bytes  before clusters grow, which tiles leave their room.
SupervoxelBytes likely_supervoxel_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                        const SupervoxelParameters& parameters, bool colours, const VoxelMemory& memory,
                                        std::uint64_t resident_bytes);

/// Peak of a run that writes labels only: tiles are cut as they would be if the voxels of a cell lay
/// in its middle. To be asked when the survey is made: what is resident then counts, what was before does not; free
/// memory is given back, as it is before supervoxels grow.
std::uint64_t predicted_supervoxel_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                         const SupervoxelParameters& parameters, bool colours,
                                         const VoxelMemory& memory);

/// What a SupervoxelScene and the table of its supervoxels keep in memory.
std::uint64_t predicted_scene_bytes(const VoxelEstimate& estimate);

/// The store of the voxels.
std::uint64_t predicted_store_bytes(const tiling::Survey& survey, const SupervoxelScale& scale, bool colours);
/// Runs, store and normals of the voxels, for inputs whose neighbours in space are neighbours in the
/// file. To be asked when the survey is made.
std::uint64_t predicted_voxel_temp_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                         const SupervoxelParameters& parameters, bool colours,
                                         const VoxelMemory& memory);

}  // namespace arris::pipeline
