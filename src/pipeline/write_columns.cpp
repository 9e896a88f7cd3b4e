#include "pipeline/write_columns.h"

#include <numeric>

#include "pipeline/batch_pass.h"

namespace arris::pipeline {

std::uint64_t write_columns(io::InputSet& inputs, const FillRows& fill, Writers& writers, ProgressSink& progress,
                            const CancelToken& cancel) {
  io::ReadOptions options;
  options.records = true;
  std::uint64_t written = 0;
  std::vector<std::uint32_t> kept;
  std::vector<std::byte> rows;
  for_each_batch(inputs, options, "write", progress, cancel, [&](std::size_t source, const io::PointBatch& batch) {
    kept.resize(batch.count);
    std::iota(kept.begin(), kept.end(), 0U);
    rows.clear();
    fill(batch.first_id, batch.count, rows);
    for (const auto& writer : writers) writer->append(source, batch, kept, rows);
    written += batch.count;
  });
  return written;
}

}  // namespace arris::pipeline
