#include "pipeline/batch_pass.h"

#include "core/read_ahead.h"

namespace arris::pipeline {
namespace {

struct BatchOfSource {
  io::PointBatch batch;
  std::size_t source = 0;
};

}  // namespace

void for_each_batch(io::InputSet& inputs, const io::ReadOptions& options, std::string_view phase,
                    ProgressSink& progress, const CancelToken& cancel,
                    const std::function<void(std::size_t source, const io::PointBatch& batch)>& use) {
  progress.phase(phase, inputs.points());
  inputs.rewind();
  read_ahead<BatchOfSource>(
      [&](BatchOfSource& read) {
        if (!inputs.read(read.batch, options)) return false;
        read.source = inputs.source_index();
        return true;
      },
      [&](const BatchOfSource& read) {
        cancel.check();
        use(read.source, read.batch);
        progress.advance(read.batch.count);
      });
}

}  // namespace arris::pipeline
