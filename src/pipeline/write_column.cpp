#include "pipeline/write_column.h"

#include <numeric>
#include <span>
#include <vector>

#include "core/parallel.h"

namespace arris::pipeline {

std::uint64_t write_column(io::InputSet& inputs, const merge::PointLabels& labels, Writers& writers,
                           ProgressSink& progress, const CancelToken& cancel) {
  progress.phase("write", inputs.points());
  io::ReadOptions options;
  options.records = true;
  struct Turn {
    io::PointBatch batch;
    std::size_t source = 0;
  };
  Turn turns[2];
  std::uint64_t written = 0;
  std::vector<std::uint32_t> kept;
  BackgroundTasks writing(1);  // Declared last: it is joined before anything that its task uses goes.
  inputs.rewind();
  for (std::size_t at = 0; inputs.read(turns[at].batch, options); at ^= 1) {
    cancel.check();
    Turn& turn = turns[at];
    turn.source = inputs.source_index();
    writing.wait();
    written += turn.batch.count;
    writing.run([&, &turn = turn] {
      kept.resize(turn.batch.count);
      std::iota(kept.begin(), kept.end(), 0U);
      const std::span<const std::uint32_t> rows(labels.data() + turn.batch.first_id, turn.batch.count);
      for (const auto& writer : writers) writer->append(turn.source, turn.batch, kept, std::as_bytes(rows));
    });
    progress.advance(turn.batch.count);
  }
  writing.wait();
  return written;
}

}  // namespace arris::pipeline
