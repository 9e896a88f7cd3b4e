#pragma once
/// @file Pass 2 of the supervoxel method: points become voxels.

#include <filesystem>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "io/point_source.h"
#include "pipeline/colour_source.h"
#include "pipeline/voxel_memory.h"
#include "tiling/survey.h"
#include "tiling/voxel_store.h"

namespace arris::pipeline {

struct VoxelStageResult {
  tiling::VoxelStore store;
  bool colours = false;  ///< Voxels have colours, full intensity 65535.
  std::uint64_t peak_temp_bytes = 0;
};

/// Streams the inputs once; points are summed while the next ones are read. Throws what reading throws.
/// @param colours  of the inputs, or nullptr: none.
VoxelStageResult run_voxel_stage(io::InputSet& inputs, const tiling::Survey& survey, const SupervoxelScale& scale,
                                 ColourSource* colours, const std::filesystem::path& folder, const VoxelMemory& memory,
                                 ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
