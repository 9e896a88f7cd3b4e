#include "pipeline/segment.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/columns.h"
#include "core/error.h"
#include "core/pages.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "merge/result_reader.h"
#include "pipeline/contour_row.h"
#include "pipeline/growth_stage.h"
#include "pipeline/outline_output.h"
#include "pipeline/outline_stage.h"
#include "pipeline/run_folder.h"
#include "pipeline/run_support.h"
#include "pipeline/segment_outputs.h"
#include "pipeline/segment_plan.h"
#include "pipeline/segment_planes.h"
#include "pipeline/segment_text.h"
#include "pipeline/write_columns.h"

namespace arris::pipeline {
namespace {

/// Of what the frontier has left: buffers of outputs take some.
constexpr std::size_t kSpareWhileWriting = std::size_t{16} << 20;

/// Before any work.
void check_outputs(const SegmentRequest& request) {
  if (request.outputs.empty()) throw ConfigError("no output given; add -o FILE");
  check_text_output(request.table, "--table", request.overwrite);
  check_outline_output(request.outlines, "--outlines", request.overwrite);
}

void check_parameters(const SegmentRequest& request) {
  validate(request.parameters);
  validate(request.shape);
  if (request.parameters.published && request.parameters.agreement)
    throw ConfigError("--agreement has no meaning with --as-published; leave one out");
}

/// Ids have 32 bits.
void refuse_too_many(const io::InputSet& inputs) {
  if (inputs.points() >= TileGrowth::kNoId)
    throw ConfigError(fmt::format("segment takes at most {} points; cut the scan into parts", TileGrowth::kNoId - 1));
}

std::vector<ColumnSpec> columns_of(const SegmentRequest& request) {
  std::vector<ColumnSpec> columns{{"SegmentId", ColumnType::kUint32, "planar segment, 0 none"}};
  if (!request.contours) return columns;
  const std::vector<ColumnSpec> contours = contour_columns(false);
  columns.insert(columns.end(), contours.begin(), contours.end());
  return columns;
}

/// Growth, planes and reassignment.
PlanarSegments find_segments(io::InputSet& inputs, const SegmentPlan& plan, const std::filesystem::path& folder,
                             SegmentReport& report, Stopwatch& watch, ProgressSink& progress,
                             const CancelToken& cancel) {
  const TileJob& job = plan.job;
  merge::SegmentFrontier frontier(folder / "frontier", report.parameters.most_neighbours());
  merge::DuplicatePoints duplicates(folder / "duplicates");
  GrowthResult growth = grow_segments(inputs, {job, report.parameters, plan.intensities.of_point, folder, watch},
                                      frontier, duplicates, progress, cancel);
  report.isolated = growth.isolated;
  report.widened_queries = growth.widened_queries;
  report.peak_temp_bytes = growth.peak_temp_bytes;
  report.frontier = frontier.records();
  PlanarSegments segments = settle_segments(inputs, {job.survey.lattice, report.parameters, folder},
                                            std::move(growth.segments), frontier, duplicates, progress, cancel);
  report.segments = segments.planes.size();
  report.labelled = segments.labelled;
  report.reassigned = segments.reassigned;
  watch.lap("planes");
  return segments;
}

/// Rows of SegmentId and, where asked for, of contours.
FillRows rows_of(const PlanarSegments& segments, merge::ResultReader* contours, SegmentReport& report) {
  return [&segments, contours, &report](std::uint64_t first_id, std::size_t count, std::vector<std::byte>& rows) {
    if (contours == nullptr) {
      const auto bytes = std::as_bytes(std::span(segments.labels).subspan(first_id, count));
      rows.assign(bytes.begin(), bytes.end());
      return;
    }
    for (std::uint64_t id = first_id; id < first_id + count; ++id) {
      const ContourRecord record = contours->at(id);
      report.boundary += (record.classes & kBoundary) != 0;
      report.fold += (record.classes & kFold) != 0;
      append_value(rows, segments.labels[id]);
      append_contour_row(rows, record, false);
    }
  };
}

}  // namespace

SegmentReport plan_segments(const SegmentRequest& request, ProgressSink& progress, const CancelToken& cancel) {
  check_parameters(request);
  SegmentReport report;
  report.parameters = request.parameters;
  RecordingSink sink(progress, report);
  Stopwatch watch(report);
  const ThreadLimit limit(request.threads);
  io::InputSet inputs(io::expand_inputs(request.inputs), request.tolerance);
  refuse_too_many(inputs);
  ProblemWarnings problems(inputs, sink);
  problems.forward();
  plan_segment_job(inputs, request, problems, report, watch, sink, cancel);
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

SegmentReport segment(const SegmentRequest& request, ProgressSink& progress, const CancelToken& cancel) {
  check_outputs(request);
  check_parameters(request);
  SegmentReport report;
  report.parameters = request.parameters;
  RecordingSink sink(progress, report);
  Stopwatch watch(report);
  const ThreadLimit limit(request.threads);
  const double cpu_before = process_cpu_seconds();
  const std::vector<std::filesystem::path> paths = io::expand_inputs(request.inputs);
  refuse_bad_outputs(request, paths);
  io::InputSet inputs(paths, request.tolerance);
  refuse_too_many(inputs);
  ProblemWarnings problems(inputs, sink);
  problems.forward();
  Writers writers = open_writers(request, inputs, columns_of(request), true, report);
  for (const std::filesystem::path& path : {request.table, request.outlines})
    if (!path.empty()) report.outputs.push_back(path.string());
  SegmentPlan plan = plan_segment_job(inputs, request, problems, report, watch, sink, cancel);
  TileJob& job = plan.job;
  const Lattice lattice = job.survey.lattice;
  const RunFolder folder(request.temp_dir);
  const PlanarSegments segments = find_segments(inputs, plan, folder.path(), report, watch, sink, cancel);
  trim_spare_pages(kSpareWhileWriting);

  report.shape = request.shape;
  report.shape.boundary = report.shape.fold = request.contours;
  report.shape.outlines = !request.outlines.empty() || !request.table.empty();
  if (report.shape.most_spacing == 0.0)
    report.shape.most_spacing = kMostContourSpacings * std::max(report.spacing, lattice.step);
  merge::ResultSpool contours(folder.path(), inputs.points());
  std::vector<merge::SegmentOutline> outlines;
  if (request.contours || report.shape.outlines) {
    OutlineResult found =
        outline_segments(inputs, job, {request, report.shape, segments, folder.path()}, contours, sink, cancel);
    outlines = std::move(found.outlines);
    report.peak_temp_bytes = std::max(report.peak_temp_bytes, found.peak_temp_bytes);
    watch.lap("contours");
  }
  merge::ResultReader reader(contours);
  report.points_out =
      write_columns(inputs, rows_of(segments, request.contours ? &reader : nullptr, report), writers, sink, cancel);
  const std::vector<merge::SegmentRow> rows = segment_rows(segments, outlines, lattice);
  if (!request.table.empty()) write_segments(request.table, rows, request.overwrite);
  if (!request.outlines.empty())
    write_outlines(request.outlines, request.overwrite, inputs, outlines, segments, rows, lattice);
  commit_writers(request, writers, inputs, report, sink);
  watch.lap("write");
  report.cpu_seconds = process_cpu_seconds() - cpu_before;
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

}  // namespace arris::pipeline
