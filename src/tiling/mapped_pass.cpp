#include "tiling/mapped_pass.h"

#include "core/read_ahead.h"

namespace arris::tiling {

MappedReader::MappedReader(io::InputSet& inputs, const Lattice& lattice)
    : inputs_(inputs), mapper_(inputs.sources(), lattice) {
  inputs_.rewind();
}

bool MappedReader::read(MappedPoints& points, std::size_t batch_points) {
  if (!fetch(points, batch_points)) return false;
  map(points);
  return true;
}

bool MappedReader::fetch(MappedPoints& points, std::size_t batch_points) {
  io::ReadOptions options;
  options.batch_points = batch_points;
  if (!inputs_.read(points.batch, options)) return false;
  points.source = inputs_.source_index();
  return true;
}

void MappedReader::map(MappedPoints& points) const {
  mapper_.map(points.batch, points.source, points.positions, points.outcome);
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
