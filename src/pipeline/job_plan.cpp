#include "pipeline/job_plan.h"

#include <algorithm>
#include <cmath>

#include "features/contour/contour_method.h"
#include "pipeline/point_selection.h"
#include "pipeline/run_support.h"
#include "pipeline/voxel_estimate.h"
#include "tiling/point_grid.h"

namespace arris::pipeline {
namespace {

/// Squares of coordinates within the search radius stay exact.
constexpr double kMostRadiusSteps = 1 << 29;
/// On disk per stored point where halos are whole: the spool, as tile files go at once. Measured.
constexpr double kFollowedBytesPerPoint = 6.5;
/// 8 for nearly one point in six, as of towns and of real scans but for those of vegetation, where it is one in four.
constexpr double kZhengResultBytesPerPoint = 2.0;
/// Of the bound of a tile, which allows for more contour points than most scans have.
constexpr double kArrisLikelyShare = 0.895;
constexpr double kLiuLikelyShare = 0.90;  // Two tiles side by side: from 190 to 240 MB of the same scan.

}  // namespace

double resolve_max_radius(const tiling::Survey& survey, double spacing, double at_least) {
  if (spacing == 0.0) spacing = survey.spacing;
  const double most = kMostRadiusSteps * survey.lattice.step;
  return std::min(most, std::max({kMaxRadiusSpacings * spacing, at_least, 4.0 * survey.lattice.step}));
}

JobPlan survey_job(io::InputSet& inputs, const ExtractRequest& request, ProgressSink& progress,
                   const CancelToken& cancel) {
  JobPlan plan;
  plan.memory_request = {request.memory_bytes, request.threads};
  plan.memory_request.method.per_point = contour_bytes_per_point(request.method);
  plan.memory_request.method.per_thread = contour_bytes_per_thread(request.method);
  if (request.method.method == ContourParameters::Method::kArris)
    plan.memory_request.method.likely_share = kArrisLikelyShare;
  if (request.method.method == ContourParameters::Method::kLiu)
    plan.memory_request.method.likely_share = kLiuLikelyShare;
  plan.memory = plan_memory(plan.memory_request);
  const tiling::PointGridPreparation preparation;
  plan.survey = tiling::survey_inputs(inputs, {request.lattice_step}, progress, cancel);
  refuse_missing_classes(request, plan.survey);
  plan.method = request.method;
  if (plan.method.by_supervoxels()) {
    ZhengParameters& zheng = plan.method.zheng;
    if (zheng.spacing == 0.0) zheng.spacing = std::max(plan.survey.spacing, plan.survey.lattice.step);
    plan.scale = resolve_scale(plan.method.supervoxel, zheng.spacing, plan.survey.lattice);
    plan.colours = wanted_colours(inputs, plan.method.supervoxel.colour, progress, cancel);
    plan.voxel_temp_bytes = predicted_voxel_temp_bytes(plan.survey, plan.scale, plan.method.supervoxel,
                                                       plan.colours != nullptr, VoxelMemory(request.memory_bytes));
  } else {
    if (plan.method.max_radius() == 0.0)
      plan.method.set_max_radius(resolve_max_radius(plan.survey, plan.method.spacing(), plan.method.fixed_radius()));
  }
  validate(plan.method);
  return plan;
}

void plan_job_tiles(JobPlan& plan, io::InputSet& inputs, const ExtractRequest& request, ProgressSink& progress,
                    const CancelToken& cancel) {
  TileNeeds needs;
  needs.halo = [&](double spacing) { return contour_halo(plan.method, spacing); };
  needs.max_radius = plan.method.max_radius();
  needs.whole_halo = plan.method.by_supervoxels();
  if (plan.method.by_supervoxels()) {
    const double cell = std::ldexp(plan.survey.lattice.step, plan.survey.counts.level());
    needs.halo_fill = std::min(1.0, contour_halo(plan.method, plan.survey.spacing) / cell);
    needs.stored_bytes_per_point = kFollowedBytesPerPoint;
    needs.likely_result_bytes_per_point = kZhengResultBytesPerPoint;
    needs.further_temp_bytes = plan.voxel_temp_bytes;
  }
  plan_tiles_of(plan, needs, inputs, request, progress, cancel);
}

void describe_plan(const JobPlan& plan, const io::InputSet& inputs, const ExtractRequest& request,
                   ExtractReport& report) {
  describe_inputs(plan.survey, inputs, request, report);
  report.parameters = plan.method;
  describe_tiles(plan, report);
}

}  // namespace arris::pipeline
