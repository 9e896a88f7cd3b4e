#include "pipeline/gather.h"

#include "features/contour/contour_method.h"
#include "merge/result_reader.h"
#include "pipeline/batch_pass.h"
#include "pipeline/contour_row.h"

namespace arris::pipeline {

void gather_points(io::InputSet& inputs, const ExtractRequest& request, const ContourParameters& method,
                   merge::ResultSpool& results, std::vector<std::unique_ptr<io::KeptPointWriter>>& writers,
                   ExtractReport& report, ProgressSink& progress, const CancelToken& cancel) {
  io::ReadOptions options;
  options.records = true;
  merge::ResultReader reader(results);
  std::vector<std::uint32_t> kept;
  std::vector<std::byte> rows;
  for_each_batch(inputs, options, "write", progress, cancel, [&](std::size_t source, const io::PointBatch& batch) {
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
    for (const auto& writer : writers) writer->append(source, batch, kept, rows);
    report.points_out += kept.size();
  });
  if (!request.keep_all) {
    report.not_contour = report.points_in - report.points_out - report.dropped_nonfinite - report.dropped_out_of_range -
                         report.dropped_excluded;
  }
}

}  // namespace arris::pipeline
