#include "pipeline/supervoxel_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "merge/supervoxel_moments.h"
#include "pipeline/voxel_memory.h"
#include "pipeline/voxel_stage.h"

namespace arris::pipeline {

SupervoxelScene make_supervoxel_scene(io::InputSet& inputs, const tiling::Survey& survey,
                                      const SupervoxelSceneRequest& request, std::unique_ptr<ColourSource> colours,
                                      ProgressSink& progress, const CancelToken& cancel) {
  const VoxelMemory memory(request.memory_bytes);
  VoxelStageResult voxels =
      run_voxel_stage(inputs, survey, request.scale, colours.get(), request.folder, memory, progress, cancel);
  colours.reset();
  trim_heap();
  const SupervoxelStageRequest stage{{request.parameters, request.scale, voxels.colours, memory.stage_bytes(),
                                      request.tile_voxels_cap, request.memory_bytes, request.folder},
                                     request.adjacency};
  SupervoxelStageResult clusters = run_supervoxel_stage(voxels.store, stage, progress, cancel);
  release_free_memory();
  const std::uint64_t predicted = memory.predicted_peak_bytes(clusters.predicted_bytes);
  const std::uint64_t peak_temp =
      std::max(voxels.peak_temp_bytes, voxels.store.bytes_on_disk() + clusters.normals_bytes_on_disk);
  return {std::move(voxels.store), std::move(clusters), voxels.colours, peak_temp, predicted};
}

void require_room_for_moments(const SupervoxelScene& scene, std::uint64_t budget_bytes) {
  const SupervoxelStageResult& clusters = scene.clusters;
  const std::uint64_t bytes =
      merge::SupervoxelMoments::most_bytes(clusters.count, scene.store.points(), clusters.adjacency.size());
  const std::uint64_t more = more_than_fits(budget_bytes, bytes);
  if (more == 0) return;
  throw BudgetError(fmt::format(
      "the table of {} supervoxels does not fit; run with at least --memory {}, or with larger --voxel or --seed",
      grouped(clusters.count), budget_text(raised_budget_bytes(budget_bytes, more))));
}

}  // namespace arris::pipeline
