#include "pipeline/label_points.h"

#include <functional>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "core/stages.h"
#include "tiling/survey.h"

namespace arris::pipeline {
namespace {

/// Of loops over the points of a batch, where there are more threads than batches on their way.
constexpr std::size_t kGrain = 2 * 1024;

struct LabelledBatch {
  io::PointBatch batch;
  std::size_t source = 0;
  std::vector<LatticePoint> positions;
  std::vector<tiling::Mapped> outcome;
  std::vector<std::uint32_t> ids;  ///< 0 for points that take no part.
};

void label(const LabelPass& pass, LabelledBatch& points) {
  pass.mapper.map(points.batch, points.source, points.positions, points.outcome);
  const std::size_t count = points.batch.count;
  points.ids.resize(count);
  const bool enough_batches = static_cast<std::size_t>(loop_threads()) <= kItemPlaces;
  parallel_for_chunks(count, enough_batches ? count : kGrain, [&](std::size_t begin, std::size_t end) {
    VoxelLabels own = pass.labels;  // Remembers where it was: one per chunk.
    own.find(std::span<const LatticePoint>(points.positions).subspan(begin, end - begin),
             std::span(points.ids).subspan(begin, end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      if (points.outcome[i] != tiling::Mapped::kOk) {
        points.ids[i] = 0;
      } else if (points.ids[i] == 0) {
        throw InputError("the inputs changed while they were read; run again when they are complete");
      }
    }
  });
}

/// Calls use(labelled batch) for all points in order, while others are read and labelled.
void for_each_labelled_batch(io::InputSet& inputs, const LabelPass& pass, bool records,
                             const std::function<void(const LabelledBatch&)>& use) {
  io::ReadOptions options;
  options.records = records;
  ItemPlaces<LabelledBatch> batches;
  const auto read = [&](std::size_t place) {
    if (!inputs.read(batches[place].batch, options)) return false;
    batches[place].source = inputs.source_index();
    return true;
  };
  const Stage label_all{StageOrder::kAnyOrder, [&](std::size_t place) { label(pass, batches[place]); }};
  const Stage use_all{StageOrder::kInTurn, [&](std::size_t place) {
                        pass.cancel.check();
                        use(batches[place]);
                        pass.progress.advance(batches[place].batch.count);
                      }};
  inputs.rewind();
  run_stages(batches.size(), read, {label_all, use_all});
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
