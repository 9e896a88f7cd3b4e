#include "pipeline/voxel_stage.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "pipeline/voxel_estimate.h"
#include "tiling/lattice_mapper.h"
#include "tiling/voxel_accumulator.h"

namespace arris::pipeline {
namespace {

/// Drops what takes no part.
void keep_mapped(std::span<const tiling::Mapped> outcome, tiling::VoxelPoints& points) {
  const bool colours = !points.colours.empty();
  std::size_t kept = 0;
  tiling::for_each_mapped_run(outcome, [&](std::size_t begin, std::size_t end) {
    if (kept != begin) {
      const auto move = [&](auto& all) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(begin);
        std::copy(first, first + static_cast<std::ptrdiff_t>(end - begin),
                  all.begin() + static_cast<std::ptrdiff_t>(kept));
      };
      move(points.positions);
      if (colours) move(points.colours);
    }
    kept += end - begin;
  });
  points.positions.resize(kept);
  if (colours) points.colours.resize(kept);
}

}  // namespace

VoxelStageResult run_voxel_stage(io::InputSet& inputs, const tiling::Survey& survey, const SupervoxelScale& scale,
                                 ColourSource* colours, const std::filesystem::path& folder, const VoxelMemory& memory,
                                 ProgressSink& progress, const CancelToken& cancel) {
  progress.phase("voxels", inputs.points());
  const tiling::LatticeMapper mapper(inputs.sources(), survey.lattice);
  tiling::VoxelAccumulator accumulator(
      VoxelGrid(scale.voxel_steps),
      {folder, memory.table_bytes(), memory.index_bytes(), static_cast<std::size_t>(likely_voxels(survey, scale))});
  io::ReadOptions options;
  options.records = colours != nullptr;
  io::PointBatch batch;
  std::vector<tiling::Mapped> outcome;
  std::uint64_t added = 0;
  inputs.rewind();
  accumulator.add_all([&](tiling::VoxelPoints& points) {
    cancel.check();
    if (!inputs.read(batch, options)) return false;
    const std::size_t source = inputs.source_index();
    mapper.map(batch, source, points.positions, outcome);
    if (colours) colours->read(batch, source, points.colours);
    keep_mapped(outcome, points);
    added += points.positions.size();
    progress.advance(batch.count);
    return true;
  });
  if (added != survey.points())
    throw InputError("the inputs changed while they were read; run again when they are complete");
  VoxelStageResult result{accumulator.finish(), colours != nullptr, 0};
  result.peak_temp_bytes = accumulator.bytes_on_disk();
  return result;
}

}  // namespace arris::pipeline
