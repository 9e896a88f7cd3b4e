#include "pipeline/gather.h"

#include <cstring>

#include "core/error.h"
#include "features/liu_method.h"

namespace arris::pipeline {
namespace {

/// One row of contour_columns(), packed.
void append_row(std::vector<std::byte>& rows, std::uint8_t edge_class, float score, float fold_angle_deg) {
  const std::size_t at = rows.size();
  rows.resize(at + 9);
  std::memcpy(&rows[at], &edge_class, 1);
  std::memcpy(&rows[at + 1], &score, 4);
  std::memcpy(&rows[at + 5], &fold_angle_deg, 4);
}

}  // namespace

std::vector<ColumnSpec> contour_columns() {
  return {{"EdgeClass", ColumnType::kUint8, "1 boundary 2 weak 4 fold"},
          {"EdgeScore", ColumnType::kFloat32, "0..1"},
          {"FoldAngle", ColumnType::kFloat32, "interior angle, degrees"}};
}

void gather_points(io::InputSet& inputs, const ExtractRequest& request, const LiuParameters& liu,
                   merge::ResultSpool& results, std::vector<std::unique_ptr<io::KeptPointWriter>>& writers,
                   ExtractReport& report, ProgressSink& progress, const CancelToken& cancel) {
  progress.phase("write", inputs.points());
  inputs.rewind();
  io::ReadOptions options;
  options.records = true;
  io::PointBatch batch;
  std::vector<merge::PointResult> bucket;
  std::size_t bucket_index = static_cast<std::size_t>(-1);
  std::vector<std::uint32_t> kept;
  std::vector<std::byte> rows;
  while (inputs.read(batch, options)) {
    cancel.check();
    kept.clear();
    rows.clear();
    for (std::size_t i = 0; i < batch.count; ++i) {
      const std::uint64_t id = batch.first_id + i;
      const std::size_t wanted = static_cast<std::size_t>(id / merge::ResultSpool::kBucketPoints);
      if (wanted != bucket_index) {
        if (wanted >= results.buckets())
          throw InputError("the inputs grew while they were read; run again when they are complete");
        results.load(wanted, bucket);
        bucket_index = wanted;
      }
      const merge::PointResult& r = bucket[id % merge::ResultSpool::kBucketPoints];
      ContourRecord record{id, r.classes, r.votes, r.gap_deg, r.fold_strength, r.fold_angle_deg};
      if (record.votes < static_cast<std::uint32_t>(liu.min_votes)) {
        record.classes = static_cast<std::uint8_t>(record.classes & ~kFold);
        record.votes = 0;
        record.fold_angle_deg = 0.0F;
      }
      if (record.classes == 0 && !request.keep_all) continue;
      report.boundary += (record.classes & kBoundary) != 0;
      report.weak_boundary += (record.classes & kWeakBoundary) != 0;
      report.fold += (record.classes & kFold) != 0;
      report.not_contour += record.classes == 0;
      kept.push_back(static_cast<std::uint32_t>(i));
      append_row(rows, record.classes, record.classes ? liu_score(record, liu) : 0.0F, record.fold_angle_deg);
    }
    for (const auto& writer : writers) writer->append(inputs.source_index(), batch, kept, rows);
    report.points_out += kept.size();
    progress.advance(batch.count);
  }
  if (!request.keep_all) {
    report.not_contour = report.points_in - report.points_out - report.dropped_nonfinite - report.dropped_out_of_range -
                         report.dropped_excluded;
  }
}

}  // namespace arris::pipeline
