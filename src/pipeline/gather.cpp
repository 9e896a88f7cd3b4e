#include "pipeline/gather.h"

#include <cstring>

#include "core/error.h"
#include "features/contour/contour_method.h"

namespace arris::pipeline {
namespace {

template <class T>
void append(std::vector<std::byte>& rows, const T& value) {
  const std::size_t at = rows.size();
  rows.resize(at + sizeof value);
  std::memcpy(&rows[at], &value, sizeof value);
}

/// One row of contour_columns(), packed.
void append_row(std::vector<std::byte>& rows, const ContourRecord& record, bool refined) {
  append(rows, record.classes);
  append(rows, record.score);
  append(rows, record.fold_angle_deg);
  if (!refined) return;
  for (const float offset : record.to_edge) append(rows, offset);
}

}  // namespace

std::vector<ColumnSpec> contour_columns(bool refined) {
  std::vector<ColumnSpec> columns{{"EdgeClass", ColumnType::kUint8, "1 boundary 2 weak 4 fold 8 16 32"},
                                  {"EdgeScore", ColumnType::kFloat32, "0..1"},
                                  {"FoldAngle", ColumnType::kFloat32, "interior angle, degrees"}};
  if (refined) {
    columns.push_back({"EdgeX", ColumnType::kFloat32, "from point to refined edge"});
    columns.push_back({"EdgeY", ColumnType::kFloat32, "from point to refined edge"});
    columns.push_back({"EdgeZ", ColumnType::kFloat32, "from point to refined edge"});
  }
  return columns;
}

void gather_points(io::InputSet& inputs, const ExtractRequest& request, const ContourParameters& method,
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
      ContourRecord record = bucket[id % merge::ResultSpool::kBucketPoints].record(id);
      finish_record(record, method);
      if (record.classes == 0 && !request.keep_all) continue;
      report.boundary += (record.classes & kBoundary) != 0;
      report.weak_boundary += (record.classes & kWeakBoundary) != 0;
      report.fold += (record.classes & kFold) != 0;
      report.contact += (record.classes & kSupervoxelContact) != 0;
      report.not_contour += record.classes == 0;
      kept.push_back(static_cast<std::uint32_t>(i));
      append_row(rows, record, request.refined);
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
