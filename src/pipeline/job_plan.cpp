#include "pipeline/job_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/text.h"
#include "features/contour/contour_method.h"
#include "pipeline/point_selection.h"
#include "pipeline/run_support.h"
#include "pipeline/voxel_memory.h"

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

}  // namespace

JobPlan survey_job(io::InputSet& inputs, const ExtractRequest& request, ProgressSink& progress,
                   const CancelToken& cancel) {
  JobPlan plan;
  plan.memory = plan_memory({request.memory_bytes, request.threads});
  plan.survey = tiling::survey_inputs(inputs, {request.lattice_step}, progress, cancel);
  refuse_missing_classes(request, plan.survey);
  plan.method = request.method;
  if (plan.method.by_supervoxels()) {
    ZhengParameters& zheng = plan.method.zheng;
    if (zheng.spacing == 0.0) zheng.spacing = std::max(plan.survey.spacing, plan.survey.lattice.step);
    plan.scale = resolve_scale(plan.method.supervoxel, zheng.spacing, plan.survey.lattice);
  } else {
    plan.method.set_max_radius(resolve_max_radius(request.method, plan.survey));
  }
  validate(plan.method);
  return plan;
}

void plan_job_tiles(JobPlan& plan, const ExtractRequest& request, ProgressSink& progress) {
  tiling::PlanRequest tiles;
  tiles.max_points = plan.memory.max_tile_points;
  tiles.max_core_points = request.tile_points_cap;
  tiles.halo = [&](double spacing) { return contour_halo(plan.method, spacing); };
  tiles.max_radius = plan.method.max_radius();
  tiles.whole_halo = plan.method.by_supervoxels();
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
  if (plan.method.by_supervoxels()) plan.predicted_temp_bytes += predicted_voxel_temp_bytes(plan.survey, plan.scale);
  check_temp_space(plan.predicted_temp_bytes, request, progress);
}

void describe_plan(const JobPlan& plan, const io::InputSet& inputs, const ExtractRequest& request,
                   ExtractReport& report) {
  describe_inputs(plan.survey, inputs, request, report);
  report.parameters = plan.method;
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
  report.predicted_peak_bytes = plan.predicted_peak_bytes;
  report.predicted_temp_bytes = plan.predicted_temp_bytes;
}

}  // namespace arris::pipeline
