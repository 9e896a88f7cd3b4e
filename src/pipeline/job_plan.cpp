#include "pipeline/job_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/text.h"
#include "features/contour_method.h"
#include "pipeline/run_folder.h"

namespace arris::pipeline {
namespace {

/// Per stored point: the spool record and its copy in the tile file (both exist while a tile is built), plus results.
constexpr double kSpoolBytesPerPoint = 20.0;
constexpr double kTileFileBytesPerPoint = 24.0;
constexpr double kResultBytesPerPoint = 8.0;

/// Squares of coordinates within the search radius stay exact.
constexpr double kMostRadiusSteps = 1 << 29;

double resolve_max_radius(const ContourParameters& method, const tiling::Survey& survey) {
  if (method.max_radius() > 0.0) return method.max_radius();
  const double spacing = method.spacing() > 0.0 ? method.spacing() : survey.spacing;
  const double most = kMostRadiusSteps * survey.lattice.step;
  return std::min(most, std::max({kMaxRadiusSpacings * spacing, method.fixed_radius(), 4.0 * survey.lattice.step}));
}

void check_temp_space(const JobPlan& plan, const ExtractRequest& request, ProgressSink& progress) {
  const TempSpace space = temp_space(request.temp_dir);
  const std::uint64_t limit =
      request.max_temp_bytes > 0 ? std::min(request.max_temp_bytes, space.free_bytes) : space.free_bytes;
  if (plan.predicted_temp_bytes > limit) {
    throw BudgetError(fmt::format(
        "temporary files need about {} but {} allows {}; free space, raise --max-temp or choose another --temp-dir",
        human_bytes(plan.predicted_temp_bytes), request.temp_dir.string(), human_bytes(limit)));
  }
  if (space.in_memory) {
    progress.warning("temp-in-memory",
                     fmt::format("{} is a file system in memory: temporary files count as memory; choose "
                                 "another --temp-dir",
                                 request.temp_dir.string()));
  }
}

}  // namespace

JobPlan plan_job(io::InputSet& inputs, const ExtractRequest& request, ProgressSink& progress,
                 const CancelToken& cancel) {
  JobPlan plan;
  plan.memory = plan_memory({request.memory_bytes, request.threads});
  plan.survey = tiling::survey_inputs(inputs, {request.lattice_step}, progress, cancel);
  plan.method = request.method;
  plan.method.set_max_radius(resolve_max_radius(request.method, plan.survey));
  validate(plan.method);

  tiling::PlanRequest tiles;
  tiles.max_points = plan.memory.max_tile_points;
  tiles.max_core_points = request.tile_points_cap;
  tiles.halo = [&](double spacing) { return contour_halo(plan.method, spacing); };
  tiles.max_radius = plan.method.max_radius();
  plan.tiles = tiling::plan_tiles(plan.survey, tiles);

  // Few tiles leave threads idle: then one tile at a time uses all of them inside.
  if (plan.tiles.tiles.size() < 4 * static_cast<std::size_t>(plan.memory.tile_workers)) plan.memory.tile_workers = 1;
  const std::uint64_t largest = tile_bytes(plan.tiles.largest_covered_points);
  while (plan.memory.tile_workers > 1 && largest * plan.memory.tile_workers > plan.memory.tiles_bytes)
    --plan.memory.tile_workers;
  if (largest > plan.memory.tiles_bytes) {
    throw BudgetError(
        fmt::format("the densest tile that cannot be split holds {} points and needs {}; run with at least --memory {}",
                    grouped(plan.tiles.largest_covered_points), human_bytes(largest),
                    human_bytes(least_budget_bytes(plan.tiles.largest_covered_points, request.threads))));
  }
  plan.predicted_peak_bytes = plan.memory.fixed_bytes + largest * static_cast<std::uint64_t>(plan.memory.tile_workers);
  const double stored = static_cast<double>(plan.survey.points()) * plan.tiles.duplication;
  plan.predicted_temp_bytes =
      static_cast<std::uint64_t>(stored * (kSpoolBytesPerPoint + kTileFileBytesPerPoint) +
                                 static_cast<double>(plan.survey.points()) * kResultBytesPerPoint) +
      plan.tiles.tiles.size() * 64 * 1024;
  check_temp_space(plan, request, progress);
  return plan;
}

void describe_plan(const JobPlan& plan, const io::InputSet& inputs, const ExtractRequest& request,
                   ExtractReport& report) {
  report.parameters = plan.method;
  report.lattice = plan.survey.lattice;
  report.bounds = plan.survey.bounds;
  report.spacing = plan.survey.spacing;
  for (const io::SourceInfo& source : inputs.sources()) {
    report.inputs.push_back({source.path.string(), source.layout, source.points, source.size_bytes, ""});
  }
  report.points_in = plan.survey.points_in;
  report.dropped_nonfinite = plan.survey.dropped_nonfinite;
  report.dropped_out_of_range = plan.survey.dropped_out_of_range;
  report.dropped_excluded = plan.survey.dropped_excluded;
  report.tiles = plan.tiles.tiles.size();
  report.largest_tile_points = plan.tiles.largest_covered_points;
  report.tile_points_limit = plan.memory.max_tile_points;
  report.tile_workers = plan.memory.tile_workers;
  report.duplication = plan.tiles.duplication;
  std::int64_t least = plan.tiles.tiles.empty() ? 0 : std::numeric_limits<std::int64_t>::max();
  std::int64_t widest = 0;
  for (const tiling::PlannedTile& tile : plan.tiles.tiles) {
    least = std::min(least, tile.core.min[0] - tile.covered.min[0]);
    widest = std::max(widest, tile.core.min[0] - tile.covered.min[0]);
  }
  report.least_halo = static_cast<double>(least) * plan.survey.lattice.step;
  report.widest_halo = static_cast<double>(widest) * plan.survey.lattice.step;
  report.threads = request.threads;
  report.memory_budget_bytes = request.memory_bytes;
  report.predicted_peak_bytes = plan.predicted_peak_bytes;
  report.predicted_temp_bytes = plan.predicted_temp_bytes;
}

}  // namespace arris::pipeline
