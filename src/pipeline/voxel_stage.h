#pragma once
/// @file Pass 2 of the supervoxel method: points become voxels.

#include <filesystem>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "io/point_source.h"
#include "pipeline/voxel_memory.h"
#include "tiling/survey.h"
#include "tiling/voxel_store.h"

namespace arris::pipeline {

struct VoxelStageResult {
  tiling::VoxelStore store;
  bool colours = false;  ///< Voxels have colours, full intensity 65535.
  std::uint64_t peak_temp_bytes = 0;
};

/// Streams the inputs once (a little more with colours); points are summed while the next ones are read. Throws
/// ConfigError if colours are demanded and an input has none; what reading throws.
VoxelStageResult run_voxel_stage(io::InputSet& inputs, const tiling::Survey& survey, const SupervoxelScale& scale,
                                 SupervoxelParameters::Colour colour, const std::filesystem::path& folder,
                                 const VoxelMemory& memory, ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
