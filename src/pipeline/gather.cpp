#include "pipeline/gather.h"

#include "features/contour/contour_method.h"
#include "merge/result_reader.h"
#include "pipeline/contour_row.h"

namespace arris::pipeline {

void gather_points(io::InputSet& inputs, const ExtractRequest& request, const ContourParameters& method,
                   merge::ResultSpool& results, std::vector<std::unique_ptr<io::KeptPointWriter>>& writers,
                   ExtractReport& report, ProgressSink& progress, const CancelToken& cancel) {
  progress.phase("write", inputs.points());
  inputs.rewind();
  io::ReadOptions options;
  options.records = true;
  io::PointBatch batch;
  merge::ResultReader reader(results);
  std::vector<std::uint32_t> kept;
  std::vector<std::byte> rows;
  while (inputs.read(batch, options)) {
    cancel.check();
    kept.clear();
    rows.clear();
    for (std::size_t i = 0; i < batch.count; ++i) {
      const std::uint64_t id = batch.first_id + i;
      ContourRecord record = reader.at(id);
      finish_record(record, method);
      if (record.classes == 0 && !request.keep_all) continue;
      report.boundary += (record.classes & kBoundary) != 0;
      report.weak_boundary += (record.classes & kWeakBoundary) != 0;
      report.fold += (record.classes & kFold) != 0;
      report.contact += (record.classes & kSupervoxelContact) != 0;
      report.not_contour += record.classes == 0;
      kept.push_back(static_cast<std::uint32_t>(i));
      append_contour_row(rows, record, request.refined);
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
