#include "pipeline/supervoxel_scene.h"

#include <algorithm>
#include <utility>

#include "core/process_memory.h"
#include "pipeline/voxel_memory.h"
#include "pipeline/voxel_stage.h"

namespace arris::pipeline {

SupervoxelScene make_supervoxel_scene(io::InputSet& inputs, const tiling::Survey& survey,
                                      const SupervoxelSceneRequest& request, ProgressSink& progress,
                                      const CancelToken& cancel) {
  const VoxelMemory memory(request.memory_bytes);
  VoxelStageResult voxels = run_voxel_stage(inputs, survey, request.scale, request.parameters.colour, request.folder,
                                            memory, progress, cancel);
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

}  // namespace arris::pipeline
