#include "pipeline/label_points.h"

#include <cstring>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "tiling/survey.h"

namespace arris::pipeline {
namespace {

constexpr std::size_t kGrain = 8 * 1024;

/// Calls use(batch, labels of its points); 0 for points that take no part.
template <class Use>
void for_each_labelled_batch(io::InputSet& inputs, const tiling::LatticeMapper& mapper, const VoxelLabels& labels,
                             bool records, const CancelToken& cancel, Use&& use) {
  io::ReadOptions options;
  options.records = records;
  io::PointBatch batch;
  std::vector<LatticePoint> positions;
  std::vector<tiling::Mapped> outcome;
  std::vector<std::uint32_t> ids;
  inputs.rewind();
  while (inputs.read(batch, options)) {
    cancel.check();
    mapper.map(batch, inputs.source_index(), positions, outcome);
    ids.assign(batch.count, 0);
    parallel_for_chunks(batch.count, kGrain, [&](std::size_t begin, std::size_t end) {
      VoxelLabels own = labels;  // Remembers where it was: one per chunk.
      for (std::size_t i = begin; i < end; ++i) {
        if (outcome[i] != tiling::Mapped::kOk) continue;
        ids[i] = own.at(positions[i]);
        if (ids[i] == 0) throw InputError("the inputs changed while they were read; run again when they are complete");
      }
    });
    use(batch, positions, ids);
  }
}

}  // namespace

void sum_moments(io::InputSet& inputs, const tiling::LatticeMapper& mapper, VoxelLabels labels,
                 merge::SupervoxelMoments& moments, ProgressSink& progress, const CancelToken& cancel) {
  progress.phase("moments", inputs.points());
  for_each_labelled_batch(inputs, mapper, labels, false, cancel,
                          [&](const io::PointBatch& batch, const std::vector<LatticePoint>& positions,
                              const std::vector<std::uint32_t>& ids) {
                            for (std::size_t i = 0; i < batch.count; ++i) {
                              if (ids[i] != 0) moments.add(ids[i], positions[i]);
                            }
                            progress.advance(batch.count);
                          });
}

std::uint64_t write_labels(io::InputSet& inputs, const tiling::LatticeMapper& mapper, VoxelLabels labels,
                           std::vector<std::unique_ptr<io::KeptPointWriter>>& writers, ProgressSink& progress,
                           const CancelToken& cancel) {
  progress.phase("write", inputs.points());
  std::uint64_t written = 0;
  std::vector<std::uint32_t> kept;
  for_each_labelled_batch(
      inputs, mapper, labels, true, cancel,
      [&](const io::PointBatch& batch, const std::vector<LatticePoint>&, const std::vector<std::uint32_t>& ids) {
        kept.resize(batch.count);
        std::iota(kept.begin(), kept.end(), 0U);
        const std::span<const std::byte> rows = std::as_bytes(std::span(ids));
        for (const auto& writer : writers) writer->append(inputs.source_index(), batch, kept, rows);
        written += batch.count;
        progress.advance(batch.count);
      });
  return written;
}

}  // namespace arris::pipeline
