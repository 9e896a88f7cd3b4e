#include "pipeline/voxel_stage.h"

#include <vector>

#include "core/error.h"
#include "core/read_ahead.h"
#include "pipeline/voxel_estimate.h"
#include "tiling/lattice_mapper.h"
#include "tiling/voxel_accumulator.h"

namespace arris::pipeline {
namespace {

struct MappedBatch {
  std::vector<LatticePoint> positions;
  std::vector<tiling::Mapped> outcome;
  std::vector<RawColour> colours;  ///< Empty without.
};

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
  std::uint64_t added = 0;
  inputs.rewind();
  read_ahead<MappedBatch>(
      [&](MappedBatch& points) {
        if (!inputs.read(batch, options)) return false;
        mapper.map(batch, inputs.source_index(), points.positions, points.outcome);
        if (colours) colours->read(batch, inputs.source_index(), points.colours);
        return true;
      },
      [&](const MappedBatch& points) {
        cancel.check();
        tiling::for_each_mapped_run(points.outcome, [&](std::size_t begin, std::size_t end) {
          const std::span<const LatticePoint> run(points.positions.data() + begin, end - begin);
          accumulator.add(
              run, colours ? std::span(points.colours).subspan(begin, end - begin) : std::span<const RawColour>());
          added += run.size();
        });
        progress.advance(points.positions.size());
      });
  if (added != survey.points())
    throw InputError("the inputs changed while they were read; run again when they are complete");
  VoxelStageResult result{accumulator.finish(), colours != nullptr, 0};
  result.peak_temp_bytes = accumulator.bytes_on_disk();
  return result;
}

}  // namespace arris::pipeline
