#include "pipeline/voxel_stage.h"

#include "core/error.h"
#include "pipeline/colour_source.h"
#include "tiling/lattice_mapper.h"
#include "tiling/voxel_accumulator.h"

namespace arris::pipeline {

VoxelStageResult run_voxel_stage(io::InputSet& inputs, const tiling::Survey& survey, const SupervoxelScale& scale,
                                 SupervoxelParameters::Colour colour, const std::filesystem::path& folder,
                                 std::size_t table_bytes, ProgressSink& progress, const CancelToken& cancel) {
  std::unique_ptr<ColourSource> colours;
  if (colour != SupervoxelParameters::Colour::kOff) colours = ColourSource::open(inputs, cancel);
  if (colour == SupervoxelParameters::Colour::kOn && !colours)
    throw ConfigError("--colour on: not every input has colours that are not all black; leave it out, or --colour off");

  progress.phase("voxels", inputs.points());
  const tiling::LatticeMapper mapper(inputs.sources(), survey.lattice);
  tiling::VoxelAccumulator accumulator(VoxelGrid(scale.voxel_steps), {folder, table_bytes});
  io::ReadOptions options;
  options.records = colours != nullptr;
  io::PointBatch batch;
  std::vector<LatticePoint> positions;
  std::vector<tiling::Mapped> outcome;
  std::vector<RawColour> batch_colours;
  std::uint64_t added = 0;
  inputs.rewind();
  while (inputs.read(batch, options)) {
    cancel.check();
    mapper.map(batch, inputs.source_index(), positions, outcome);
    if (colours) colours->read(batch, inputs.source_index(), batch_colours);
    tiling::for_each_mapped_run(outcome, [&](std::size_t begin, std::size_t end) {
      const std::span<const LatticePoint> run(positions.data() + begin, end - begin);
      accumulator.add(run, colours ? std::span<const RawColour>(batch_colours.data() + begin, end - begin)
                                   : std::span<const RawColour>());
      added += run.size();
    });
    progress.advance(batch.count);
  }
  if (added != survey.points())
    throw InputError("the inputs changed while they were read; run again when they are complete");
  VoxelStageResult result{accumulator.finish(), colours != nullptr, 0};
  result.peak_temp_bytes = accumulator.bytes_on_disk();
  return result;
}

}  // namespace arris::pipeline
