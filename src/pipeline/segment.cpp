#include "pipeline/segment.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/columns.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "merge/result_reader.h"
#include "pipeline/contour_row.h"
#include "pipeline/ground_stage.h"
#include "pipeline/growth_stage.h"
#include "pipeline/job_plan.h"
#include "pipeline/noise_stage.h"
#include "pipeline/outline_output.h"
#include "pipeline/outline_stage.h"
#include "pipeline/point_selection.h"
#include "pipeline/run_folder.h"
#include "pipeline/run_support.h"
#include "pipeline/segment_outputs.h"
#include "pipeline/segment_planes.h"
#include "pipeline/segment_text.h"
#include "pipeline/write_columns.h"

namespace arris::pipeline {
namespace {

/// A component of 8 points is as small as most are; their table is in memory.
constexpr double kComponentBytesPerPoint = 2.0;

/// What a scan of n points keeps in memory besides its tiles.
std::uint64_t kept_bytes(std::uint64_t points) {
  const double per_point = merge::kLabelBytesPerPoint + kComponentBytesPerPoint;
  return static_cast<std::uint64_t>(per_point * static_cast<double>(points));
}

TileJob plan_job(tiling::Survey survey, const SegmentRequest& request, SegmentParameters& parameters,
                 std::uint64_t kept, ProgressSink& progress) {
  TileJob job;
  job.survey = std::move(survey);
  job.memory_request = {
      request.memory_bytes, request.threads, kept, {growth_bytes_per_point(parameters), kGrowthBytesPerThread}};
  job.memory = plan_memory(job.memory_request);
  TileNeeds needs;
  needs.halo = [&](double spacing) { return segment_halo(parameters, spacing); };
  needs.max_radius = (parameters.published ? 2.0 : 3.0) * parameters.reach();
  // Half of the points on the frontier is more than real scans have.
  needs.result_bytes_per_point = 0.5 * 4.0 * static_cast<double>(4 + parameters.most_neighbours());
  plan_tiles_of(job, needs, request, progress);
  return job;
}

/// Empty, and the parameter off, where the inputs have none.
IntensityTable use_intensities(io::InputSet& inputs, SegmentParameters& parameters, ProgressSink& progress,
                               const CancelToken& cancel) {
  if (!parameters.intensity) return {};
  IntensityTable table = read_intensities(inputs, progress, cancel);
  if (!table.complete() && inputs.points() > 0) {
    table.files.clear();
    parameters.intensity = false;
    progress.warning("no-intensity", "not all inputs have intensities; segments are told apart by their shape alone");
  }
  return table;
}

/// Before any work.
void check_request(const SegmentRequest& request) {
  if (request.outputs.empty()) throw ConfigError("no output given; add -o FILE");
  check_text_output(request.table, "--table", request.overwrite);
  check_outline_output(request.outlines, "--outlines", request.overwrite);
  validate(request.parameters);
  validate(request.shape);
  if (request.parameters.published && request.parameters.agreement)
    throw ConfigError("--agreement has no meaning with --as-published; leave one out");
}

std::vector<ColumnSpec> columns_of(const SegmentRequest& request) {
  std::vector<ColumnSpec> columns{{"SegmentId", ColumnType::kUint32, "planar segment, 0 none"}};
  if (!request.contours) return columns;
  const std::vector<ColumnSpec> contours = contour_columns(false);
  columns.insert(columns.end(), contours.begin(), contours.end());
  return columns;
}

/// What of the inputs takes part: intensities, then exclusions, then heights.
IntensityTable choose_points(io::InputSet& inputs, const SegmentRequest& request, SegmentReport& report,
                             Stopwatch& watch, ProgressSink& progress, const CancelToken& cancel) {
  // Before the exclusions, which neither the scale of intensities nor the ground must depend on.
  IntensityTable intensities = use_intensities(inputs, report.parameters, progress, cancel);
  report.intensities = intensities.files;
  if (report.parameters.intensity) watch.lap("intensity");
  inputs.exclude(request.exclusion);
  if (request.min_height) {
    report.min_height = request.min_height;
    inputs.add_filter(above_ground(std::make_shared<const GroundModel>(read_ground(inputs, progress, cancel)),
                                   *request.min_height, inputs.sources()));
    watch.lap("ground");
  }
  return intensities;
}

/// Unless given, the number of neighbours follows the noise.
void choose_neighbours(io::InputSet& inputs, const tiling::Survey& survey, SegmentParameters& p, Stopwatch& watch,
                       ProgressSink& progress, const CancelToken& cancel) {
  if (!p.adaptive()) return;
  const ScanNoise found = estimate_noise(inputs, survey, progress, cancel);
  p.noise = found.noise;
  if (found.least_spacing > 0.0) p.most_by_noise = neighbours_for(found.noise / found.least_spacing);
  watch.lap("noise");
}

/// Growth, planes and reassignment.
PlanarSegments find_segments(io::InputSet& inputs, const SegmentRequest& request, const TileJob& job,
                             const IntensityTable& intensities, const std::filesystem::path& folder,
                             SegmentReport& report, Stopwatch& watch, ProgressSink& progress,
                             const CancelToken& cancel) {
  merge::SegmentFrontier frontier(folder / "frontier", report.parameters.most_neighbours());
  merge::DuplicatePoints duplicates(folder / "duplicates");
  GrowthResult growth =
      grow_segments(inputs, {job, report.parameters, intensities.of_point, request.threads, folder, watch}, frontier,
                    duplicates, progress, cancel);
  report.isolated = growth.isolated;
  report.widened_queries = growth.widened_queries;
  report.peak_temp_bytes = growth.peak_temp_bytes;
  report.frontier = frontier.records();
  const ThreadLimit limit(request.threads);
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

SegmentReport segment(const SegmentRequest& request, ProgressSink& progress, const CancelToken& cancel) {
  check_request(request);
  SegmentReport report;
  report.parameters = request.parameters;
  RecordingSink sink(progress, report);
  Stopwatch watch(report);
  const double cpu_before = process_cpu_seconds();
  const std::vector<std::filesystem::path> paths = io::expand_inputs(request.inputs);
  refuse_bad_outputs(request, paths);
  io::InputSet inputs(paths, request.tolerance);
  if (inputs.points() >= TileGrowth::kNoId)
    throw ConfigError(fmt::format("segment takes at most {} points; cut the scan into parts", TileGrowth::kNoId - 1));
  ProblemWarnings problems(inputs, sink);
  problems.forward();
  Writers writers = open_writers(request, inputs, columns_of(request), true, report);
  for (const std::filesystem::path& path : {request.table, request.outlines})
    if (!path.empty()) report.outputs.push_back(path.string());
  const IntensityTable intensities = choose_points(inputs, request, report, watch, sink, cancel);

  tiling::Survey survey = tiling::survey_inputs(inputs, {request.lattice_step}, sink, cancel);
  problems.forward();
  refuse_missing_classes(request, survey);
  describe_inputs(survey, inputs, request, report);
  warn_of_dropped(report, sink);
  if (report.parameters.max_radius == 0.0)
    report.parameters.max_radius = resolve_max_radius(survey, 0.0, report.parameters.radius);
  const Lattice lattice = survey.lattice;
  watch.lap("survey");
  choose_neighbours(inputs, survey, report.parameters, watch, sink, cancel);

  const RunFolder folder(request.temp_dir);
  TileJob job = plan_job(std::move(survey), request, report.parameters, kept_bytes(inputs.points()), sink);
  report.tiles = job.tiles.tiles.size();
  report.largest_tile_points = job.tiles.largest_covered_points;
  report.tile_workers = job.memory.tile_workers;
  report.predicted_peak_bytes = job.predicted_peak_bytes;
  report.predicted_temp_bytes = job.predicted_temp_bytes;
  const PlanarSegments segments =
      find_segments(inputs, request, job, intensities, folder.path(), report, watch, sink, cancel);

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
  commit_writers(writers, inputs, sink);
  watch.lap("write");
  hash_inputs(request, report);
  report.cpu_seconds = process_cpu_seconds() - cpu_before;
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

}  // namespace arris::pipeline
