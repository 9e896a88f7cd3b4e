#include "pipeline/segment_plan.h"

#include <memory>

#include "core/process_memory.h"
#include "features/segment/neighbour_rule.h"
#include "features/segment/tile_growth.h"
#include "merge/point_labels.h"
#include "pipeline/cell_sample.h"
#include "pipeline/frontier_estimate.h"
#include "pipeline/ground_stage.h"
#include "pipeline/job_plan.h"
#include "pipeline/noise_stage.h"
#include "pipeline/point_selection.h"
#include "tiling/point_grid.h"

namespace arris::pipeline {
namespace {

/// The table of components and the links that wait for other tiles: scans have a component for 60 points or more, as
/// published for 10, where points of vegetation are linked one by one.
constexpr double kComponentBytesPerPoint = 0.5;
constexpr double kPublishedComponentBytesPerPoint = 2.5;
/// Most of the time of a tile is the search for neighbours, when most of its bytes are there.
constexpr double kBesideAnother = 0.85;
/// Bytes of the frontier in memory for one on disk, as it is foretold. Measured.
constexpr double kFrontierInMemory = 3.3;

/// What a scan of n points keeps in memory besides its tiles.
std::uint64_t kept_bytes(std::uint64_t points, bool published) {
  const double per_point =
      merge::kLabelBytesPerPoint + (published ? kPublishedComponentBytesPerPoint : kComponentBytesPerPoint);
  return static_cast<std::uint64_t>(per_point * static_cast<double>(points));
}

TileJob plan_job(io::InputSet& inputs, tiling::Survey survey, const SegmentRequest& request,
                 SegmentParameters& parameters, double frontier_bytes, ProgressSink& progress,
                 const CancelToken& cancel) {
  const std::uint64_t points = inputs.points();
  TileJob job;
  job.survey = std::move(survey);
  job.memory_request = {request.memory_bytes,
                        request.threads,
                        kept_bytes(points, parameters.published),
                        parameters.intensity ? points : 0,
                        {growth_bytes_per_point(parameters), kGrowthBytesPerThread, kBesideAnother}};
  job.memory = plan_memory(job.memory_request);
  TileNeeds needs;
  needs.halo = [&](double spacing) { return segment_halo(parameters, spacing); };
  needs.max_radius = (parameters.published ? 2.0 : 3.0) * parameters.reach();
  needs.asks_again = true;
  needs.in_turn = true;
  needs.stored_bytes_per_point = 14.5;  // Most tile files wait for queries.
  needs.likely_result_bytes_per_point = frontier_bytes;
  needs.most_result_bytes_per_point = most_frontier_bytes_per_point(parameters);
  needs.likely_later_bytes = kFrontierInMemory * frontier_bytes * static_cast<double>(job.survey.points());
  plan_tiles_of(job, needs, inputs, request, progress, cancel);
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

/// Unless given, the number of neighbours follows the noise. @return bytes of the frontier per point.
double look_at_samples(io::InputSet& inputs, const tiling::Survey& survey, std::span<const std::uint8_t> intensities,
                       SegmentParameters& p, ProgressSink& progress, const CancelToken& cancel) {
  const double points = frontier_sample(survey.points());
  std::vector<CellSample> samples{{survey, kFrontierCellSpacings, points},
                                  {survey, kSmallFrontierCellSpacings, points}};
  if (p.adaptive()) samples.emplace_back(survey, kNoiseCellSpacings, kNoiseSample);
  draw_cells(inputs, survey, samples, progress, cancel);
  if (p.adaptive()) {
    const ScanNoise found = estimate_noise(samples.back(), survey.lattice);
    p.noise = found.noise;
    if (found.least_spacing > 0.0) p.most_by_noise = neighbours_for(found.noise / found.least_spacing);
  }
  return frontier_bytes_per_point({samples[0], samples[1]}, intensities, survey, p);
}

}  // namespace

SegmentPlan plan_segment_job(io::InputSet& inputs, const SegmentRequest& request, ProblemWarnings& problems,
                             SegmentReport& report, Stopwatch& watch, ProgressSink& progress,
                             const CancelToken& cancel) {
  SegmentPlan plan;
  const tiling::PointGridPreparation preparation;
  plan.intensities = choose_points(inputs, request, report, watch, progress, cancel);
  tiling::Survey survey = tiling::survey_inputs(inputs, {request.lattice_step}, progress, cancel);
  problems.forward();
  refuse_missing_classes(request, survey);
  describe_inputs(survey, inputs, request, report);
  warn_of_dropped(report, progress);
  if (report.parameters.max_radius == 0.0)
    report.parameters.max_radius = resolve_max_radius(survey, 0.0, report.parameters.radius);
  watch.lap("survey");
  const double frontier_bytes =
      look_at_samples(inputs, survey, plan.intensities.of_point, report.parameters, progress, cancel);
  watch.lap("noise");
  release_free_memory();
  plan.job = plan_job(inputs, std::move(survey), request, report.parameters, frontier_bytes, progress, cancel);
  describe_tiles(plan.job, report);
  return plan;
}

}  // namespace arris::pipeline
