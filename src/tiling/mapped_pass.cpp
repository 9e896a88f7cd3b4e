#include "tiling/mapped_pass.h"

#include <vector>

namespace arris::tiling {

void for_each_mapped_batch(io::InputSet& inputs, const Lattice& lattice, std::string_view phase, ProgressSink& progress,
                           const CancelToken& cancel, const std::function<void(const MappedPoints&)>& use) {
  const LatticeMapper mapper(inputs.sources(), lattice);
  const io::ReadOptions options;
  io::PointBatch batch;
  std::vector<LatticePoint> positions;
  std::vector<Mapped> outcome;
  progress.phase(phase, inputs.points());
  inputs.rewind();
  while (inputs.read(batch, options)) {
    cancel.check();
    mapper.map(batch, inputs.source_index(), positions, outcome);
    use({batch, positions, outcome});
    progress.advance(batch.count);
  }
}

}  // namespace arris::tiling
