#pragma once
/// @file A scan as supervoxels: what both `arris supervoxel` and the method zheng begin with.

#include <filesystem>
#include <memory>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "io/point_source.h"
#include "pipeline/colour_source.h"
#include "pipeline/supervoxel_stage.h"
#include "pipeline/voxel_labels.h"
#include "tiling/survey.h"
#include "tiling/voxel_store.h"

namespace arris::pipeline {

struct SupervoxelSceneRequest {
  SupervoxelParameters parameters;  ///< Resolved.
  SupervoxelScale scale;
  std::uint64_t memory_bytes = 0;  ///< Budget of the whole process.
  std::uint64_t tile_voxels_cap = 0;
  bool adjacency = false;
  std::filesystem::path folder;  ///< For temporary files.
};

/// No two points of a supervoxel are further apart along an axis than this many seed cells: growth reaches 1.8 on both
/// sides of a seed, and the coarsest voxels are half a cell wide.
constexpr std::int64_t kReachCells = 8;

/// Voxels of all points and the supervoxel of each. Keeps in memory about 7 bytes per voxel, and the adjacency.
struct SupervoxelScene {
  tiling::VoxelStore store;
  SupervoxelStageResult clusters;
  bool colours = false;
  std::uint64_t peak_temp_bytes = 0;
  std::uint64_t predicted_peak_bytes = 0;  ///< Of the process while supervoxels grew.

  VoxelLabels labels() const { return VoxelLabels(store, clusters); }
};

/// Throws BudgetError unless the moments of all supervoxels and their table fit beside what is resident.
void require_room_for_moments(const SupervoxelScene& scene, std::uint64_t budget_bytes);

/// Voxel pass and clustering. @param colours  of the inputs, gone when voxels have theirs; nullptr: none. Throws BudgetError, IoError, Cancelled, and what reading throws.
SupervoxelScene make_supervoxel_scene(io::InputSet& inputs, const tiling::Survey& survey,
                                      const SupervoxelSceneRequest& request, std::unique_ptr<ColourSource> colours,
                                      ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
