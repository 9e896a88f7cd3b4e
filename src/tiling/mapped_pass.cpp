#include "tiling/mapped_pass.h"

#include <atomic>
#include <mutex>

#include "core/parallel.h"
#include "core/read_ahead.h"

namespace arris::tiling {

MappedReader::MappedReader(io::InputSet& inputs, const Lattice& lattice)
    : inputs_(inputs), mapper_(inputs.sources(), lattice) {
  inputs_.rewind();
}

bool MappedReader::read(MappedPoints& points) {
  if (!inputs_.read(points.batch, {})) return false;
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

void for_each_mapped_batch_unordered(io::InputSet& inputs, const Lattice& lattice, std::string_view phase,
                                     ProgressSink& progress, const CancelToken& cancel, std::size_t lanes,
                                     const std::function<void(std::size_t lane, const MappedPoints&)>& use) {
  const LatticeMapper mapper(inputs.sources(), lattice);
  const io::ReadOptions options;
  progress.phase(phase, inputs.points());
  inputs.rewind();
  std::mutex reading;
  std::atomic<bool> failed{false};
  parallel_for_chunks(lanes, 1, [&](std::size_t lane, std::size_t) {
    MappedPoints points;
    try {
      while (!failed) {
        cancel.check();
        std::size_t source = 0;
        {
          const std::lock_guard lock(reading);
          if (!inputs.read(points.batch, options)) return;
          source = inputs.source_index();
        }
        mapper.map(points.batch, source, points.positions, points.outcome);
        use(lane, points);
        progress.advance(points.batch.count);
      }
    } catch (...) {
      failed = true;  // The other lanes need not read on.
      throw;
    }
  });
}

}  // namespace arris::tiling
