#include "pipeline/segment.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "pipeline/ground_stage.h"
#include "pipeline/growth_stage.h"
#include "pipeline/job_plan.h"
#include "pipeline/point_selection.h"
#include "pipeline/run_folder.h"
#include "pipeline/run_support.h"
#include "pipeline/segment_planes.h"
#include "pipeline/write_column.h"

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

}  // namespace

SegmentReport segment(const SegmentRequest& request, ProgressSink& progress, const CancelToken& cancel) {
  if (request.outputs.empty()) throw ConfigError("no output given; add -o FILE");
  SegmentReport report;
  report.parameters = request.parameters;
  validate(report.parameters);
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
  Writers writers =
      open_writers(request, inputs, {{"SegmentId", ColumnType::kUint32, "planar segment, 0 none"}}, true, report);
  // Before the exclusions, which neither the scale of intensities nor the ground must depend on.
  const IntensityTable intensities = use_intensities(inputs, report.parameters, sink, cancel);
  report.intensities = intensities.files;
  if (report.parameters.intensity) watch.lap("intensity");
  inputs.exclude(request.exclusion);
  if (request.min_height) {
    report.min_height = request.min_height;
    inputs.add_filter(above_ground(std::make_shared<const GroundModel>(read_ground(inputs, sink, cancel)),
                                   *request.min_height, inputs.sources()));
    watch.lap("ground");
  }

  tiling::Survey survey = tiling::survey_inputs(inputs, {request.lattice_step}, sink, cancel);
  problems.forward();
  refuse_missing_classes(request, survey);
  describe_inputs(survey, inputs, request, report);
  warn_of_dropped(report, sink);
  if (report.parameters.max_radius == 0.0)
    report.parameters.max_radius = resolve_max_radius(survey, 0.0, report.parameters.radius);
  watch.lap("survey");

  const RunFolder folder(request.temp_dir);
  const TileJob job = plan_job(std::move(survey), request, report.parameters, kept_bytes(inputs.points()), sink);
  report.tiles = job.tiles.tiles.size();
  report.largest_tile_points = job.tiles.largest_covered_points;
  report.tile_workers = job.memory.tile_workers;
  report.predicted_peak_bytes = job.predicted_peak_bytes;
  report.predicted_temp_bytes = job.predicted_temp_bytes;

  merge::SegmentFrontier frontier(folder.path() / "frontier", report.parameters.most_neighbours());
  merge::DuplicatePoints duplicates(folder.path() / "duplicates");
  GrowthResult growth =
      grow_segments(inputs, {job, report.parameters, intensities.of_point, request.threads, folder.path()}, frontier,
                    duplicates, sink, cancel);
  report.isolated = growth.isolated;
  report.widened_queries = growth.widened_queries;
  report.peak_temp_bytes = growth.peak_temp_bytes;
  report.frontier = frontier.records();
  watch.lap("growth");

  const ThreadLimit limit(request.threads);
  const PlanarSegments segments = settle_segments(inputs, {job.survey.lattice, report.parameters, folder.path()},
                                                  std::move(growth.segments), frontier, duplicates, sink, cancel);
  report.segments = segments.planes.size();
  report.labelled = segments.labelled;
  report.reassigned = segments.reassigned;
  watch.lap("planes");
  report.points_out = write_column(inputs, segments.labels, writers, sink, cancel);
  commit_writers(writers, inputs, sink);
  watch.lap("write");
  hash_inputs(request, report);
  report.cpu_seconds = process_cpu_seconds() - cpu_before;
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

}  // namespace arris::pipeline
