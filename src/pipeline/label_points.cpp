#include "pipeline/label_points.h"

#include <functional>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "tiling/survey.h"

namespace arris::pipeline {
namespace {

constexpr std::size_t kGrain = 8 * 1024;

struct LabelledBatch {
  io::PointBatch batch;
  std::size_t source = 0;
  std::vector<LatticePoint> positions;
  std::vector<std::uint32_t> ids;  ///< 0 for points that take no part.
};

/// Calls use(labelled batch) for all points in order; with more than one thread on another one, while the next batch is
/// read.
void for_each_labelled_batch(io::InputSet& inputs, const LabelPass& pass, bool records,
                             const std::function<void(const LabelledBatch&)>& use) {
  io::ReadOptions options;
  options.records = records;
  std::vector<tiling::Mapped> outcome;
  LabelledBatch buffers[2];
  // Declared last: it is joined before anything that its task uses goes.
  std::optional<BackgroundTasks> other_thread;
  if (pass.threads > 1) other_thread.emplace(1);
  inputs.rewind();
  for (std::size_t turn = 0; inputs.read(buffers[turn].batch, options); turn ^= 1) {
    pass.cancel.check();
    LabelledBatch& points = buffers[turn];
    points.source = inputs.source_index();
    pass.mapper.map(points.batch, points.source, points.positions, outcome);
    points.ids.assign(points.batch.count, 0);
    parallel_for_chunks(points.batch.count, kGrain, [&](std::size_t begin, std::size_t end) {
      VoxelLabels own = pass.labels;  // Remembers where it was: one per chunk.
      for (std::size_t i = begin; i < end; ++i) {
        if (outcome[i] != tiling::Mapped::kOk) continue;
        points.ids[i] = own.at(points.positions[i]);
        if (points.ids[i] == 0)
          throw InputError("the inputs changed while they were read; run again when they are complete");
      }
    });
    if (other_thread) {
      other_thread->wait();
      other_thread->run([&use, &points] { use(points); });
    } else {
      use(points);
    }
    pass.progress.advance(points.batch.count);
  }
  if (other_thread) other_thread->wait();
}

}  // namespace

void sum_moments(io::InputSet& inputs, const LabelPass& pass, merge::SupervoxelMoments& moments) {
  pass.progress.phase("moments", inputs.points());
  for_each_labelled_batch(inputs, pass, false, [&](const LabelledBatch& points) {
    for (std::size_t i = 0; i < points.ids.size(); ++i) {
      if (points.ids[i] != 0) moments.add(points.ids[i], points.positions[i]);
    }
  });
}

std::uint64_t write_labels(io::InputSet& inputs, const LabelPass& pass,
                           std::vector<std::unique_ptr<io::KeptPointWriter>>& writers) {
  pass.progress.phase("write", inputs.points());
  std::uint64_t written = 0;
  std::vector<std::uint32_t> kept;
  for_each_labelled_batch(inputs, pass, true, [&](const LabelledBatch& points) {
    kept.resize(points.batch.count);
    std::iota(kept.begin(), kept.end(), 0U);
    const std::span<const std::byte> rows = std::as_bytes(std::span(points.ids));
    for (const auto& writer : writers) writer->append(points.source, points.batch, kept, rows);
    written += points.batch.count;
  });
  return written;
}

}  // namespace arris::pipeline
