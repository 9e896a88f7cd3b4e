#include "tiling/mapped_pass.h"

#include "core/read_ahead.h"

namespace arris::tiling {

MappedReader::MappedReader(io::InputSet& inputs, const Lattice& lattice)
    : inputs_(inputs), mapper_(inputs.sources(), lattice) {
  inputs_.rewind();
}

bool MappedReader::read(MappedPoints& points, std::size_t batch_points) {
  io::ReadOptions options;
  options.batch_points = batch_points;
  if (!inputs_.read(points.batch, options)) return false;
  mapper_.map(points.batch, inputs_.source_index(), points.positions, points.outcome);
  return true;
}

void for_each_mapped_batch(io::InputSet& inputs, const Lattice& lattice, std::string_view phase, ProgressSink& progress,
                           const CancelToken& cancel, const std::function<void(const MappedPoints&)>& use) {
  progress.phase(phase, inputs.points());
  MappedReader reader(inputs, lattice);
  read_ahead<MappedPoints>([&](MappedPoints& points) { return reader.read(points); },
                           [&](const MappedPoints& points) {
                             cancel.check();
                             use(points);
                             progress.advance(points.batch.count);
                           });
}

}  // namespace arris::tiling
