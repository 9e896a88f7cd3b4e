#include "pipeline/label_points.h"

#include <functional>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "core/read_ahead.h"
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

/// Calls use(labelled batch) for all points in order, while the next batch is read and labelled.
void for_each_labelled_batch(io::InputSet& inputs, const LabelPass& pass, bool records,
                             const std::function<void(const LabelledBatch&)>& use) {
  io::ReadOptions options;
  options.records = records;
  std::vector<tiling::Mapped> outcome;
  const auto fill = [&](LabelledBatch& points) {
    if (!inputs.read(points.batch, options)) return false;
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
    return true;
  };
  inputs.rewind();
  read_ahead<LabelledBatch>(fill, [&](const LabelledBatch& points) {
    pass.cancel.check();
    use(points);
    pass.progress.advance(points.batch.count);
  });
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
