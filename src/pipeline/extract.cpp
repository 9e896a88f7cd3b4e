#include "pipeline/extract.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/error.h"
#include "core/memory_budget.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "io/point_source.h"
#include "io/point_writer.h"
#include "merge/result_spool.h"
#include "pipeline/contour_row.h"
#include "pipeline/gather.h"
#include "pipeline/job_plan.h"
#include "pipeline/label_points.h"
#include "pipeline/run_folder.h"
#include "pipeline/run_support.h"
#include "pipeline/supervoxel_scene.h"
#include "pipeline/tile_stage.h"
#include "pipeline/voxel_estimate.h"
#include "pipeline/voxel_memory.h"
#include "pipeline/widen_stage.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {
namespace {

constexpr std::size_t kLabelGrain = 8 * 1024;

/// Supervoxels of the scan, as the method zheng asks for them.
struct LabelledScene {
  SupervoxelScene scene;
  SupervoxelTable table;
};

std::unique_ptr<const LabelledScene> label_scene(io::InputSet& inputs, JobPlan& plan,
                                                 const ExtractRequest& request, const std::filesystem::path& folder,
                                                 ProgressSink& progress, const CancelToken& cancel) {
  auto labelled = std::make_unique<LabelledScene>(
      LabelledScene{make_supervoxel_scene(inputs, plan.survey,
                                          {plan.method.supervoxel, plan.scale, request.memory_bytes,
                                           request.tile_points_cap, true, folder},
                                          std::move(plan.colours), progress, cancel),
                    {}});
  require_room_for_moments(labelled->scene, request.memory_bytes);
  merge::SupervoxelMoments moments(labelled->scene.clusters.count, kReachCells * plan.scale.seed_steps);
  const tiling::LatticeMapper mapper(inputs.sources(), plan.survey.lattice);
  sum_moments(inputs, {mapper, labelled->scene.labels(), progress, cancel}, moments);
  labelled->table = moments.table(labelled->scene.clusters.adjacency);
  labelled->scene.clusters.adjacency = {};
  return labelled;
}

TileContours extract_labelled(const TilePoints& points, const JobPlan& plan, const LabelledScene& labelled) {
  std::vector<std::uint32_t> labels(points.positions.size());
  parallel_for_chunks(labels.size(), kLabelGrain, [&](std::size_t begin, std::size_t end) {
    VoxelLabels label_of = labelled.scene.labels();  // Remembers where it was: one per chunk.
    label_of.find(std::span<const LatticePoint>(points.positions).subspan(begin, end - begin),
                  std::span(labels).subspan(begin, end - begin));
  });
  return extract_zheng(points, labels, labelled.table, plan.survey.lattice, plan.method.zheng);
}

/// What the method does with a tile. @param labelled  null unless the method works by supervoxels, which has no
/// unproven queries and so is never asked about some of a tile's points.
TileAnalysis analysis_of(const JobPlan& plan, const LabelledScene* labelled, merge::ResultSpool& results) {
  return [&plan, &results, labelled](const TilePoints& points, std::optional<std::span<const PlacedQuery>> queries,
                                     const std::function<void()>& let_others_begin) {
    std::vector<std::uint32_t> entries;
    if (queries) {
      for (const PlacedQuery& query : *queries) entries.push_back(query.entry);
    }
    TileContours found = labelled  ? extract_labelled(points, plan, *labelled)
                         : queries ? extract_contours(points, plan.survey.lattice, plan.method, entries)
                                   : extract_contours(points, plan.survey.lattice, plan.method);
    let_others_begin();
    results.append(std::move(found.records));
    return TileOutcome{std::move(found.unproven), found.isolated};
  };
}

}  // namespace

ExtractReport plan_only(const ExtractRequest& request, ProgressSink& progress, const CancelToken& cancel) {
  ExtractReport report;
  RecordingSink sink(progress, report);
  Stopwatch watch(report);
  const ThreadLimit limit(request.threads);
  io::InputSet inputs(io::expand_inputs(request.inputs), request.tolerance);
  inputs.exclude(request.exclusion);
  JobPlan plan = survey_job(inputs, request, sink, cancel);
  std::uint64_t supervoxel_bytes = 0, voxel_temp_bytes = 0;
  if (plan.method.by_supervoxels()) {
    const bool colours = plan.colours != nullptr;
    supervoxel_bytes = std::max(peak_resident_bytes(),
                                predicted_supervoxel_bytes(plan.survey, plan.scale, plan.method.supervoxel, colours,
                                                           VoxelMemory(request.memory_bytes)));
    voxel_temp_bytes = plan.voxel_temp_bytes;
    plan.voxel_temp_bytes = predicted_store_bytes(plan.survey, plan.scale, colours);
    plan.memory_request.kept_bytes = predicted_scene_bytes(estimate_voxels(plan.survey, plan.scale));
    plan.memory = plan_memory(plan.memory_request);
  }
  plan_job_tiles(plan, inputs, request, sink, cancel);
  describe_plan(plan, inputs, request, report);
  report.predicted_peak_bytes = std::max(report.predicted_peak_bytes, supervoxel_bytes);
  report.predicted_temp_bytes = std::max(report.predicted_temp_bytes, voxel_temp_bytes);
  warn_of_dropped(report, sink);
  watch.lap("survey");
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

ExtractReport extract(const ExtractRequest& request, ProgressSink& progress, const CancelToken& cancel) {
  if (request.outputs.empty()) throw ConfigError("no output given; add -o FILE");
  ExtractReport report;
  RecordingSink sink(progress, report);
  Stopwatch watch(report);
  const ThreadLimit limit(request.threads);
  const double cpu_before = process_cpu_seconds();

  const std::vector<std::filesystem::path> paths = io::expand_inputs(request.inputs);
  refuse_bad_outputs(request, paths);
  io::InputSet inputs(paths, request.tolerance);
  ProblemWarnings problems(inputs, sink);
  problems.forward();
  Writers writers = open_writers(request, inputs, contour_columns(request.refined), request.keep_all, report);
  inputs.exclude(request.exclusion);
  JobPlan plan = survey_job(inputs, request, sink, cancel);
  problems.forward();
  watch.lap("survey");
  const RunFolder folder(request.temp_dir);
  std::unique_ptr<const LabelledScene> labelled;
  if (plan.method.by_supervoxels() && plan.method.any_test()) {
    labelled = label_scene(inputs, plan, request, folder.path(), sink, cancel);
    report.voxels = labelled->scene.store.size();
    report.supervoxels = labelled->scene.clusters.count;
    report.voxel_tiles = labelled->scene.clusters.tiles;
    report.peak_temp_bytes = labelled->scene.peak_temp_bytes;
    plan.memory = plan_memory(plan.memory_request);
    plan.voxel_temp_bytes = labelled->scene.store.bytes_on_disk();
    watch.lap("supervoxels");
  }
  plan_job_tiles(plan, inputs, request, sink, cancel);
  describe_plan(plan, inputs, request, report);
  warn_of_dropped(report, sink);
  if (labelled) {
    report.predicted_peak_bytes = std::max(report.predicted_peak_bytes, labelled->scene.predicted_peak_bytes);
    report.predicted_temp_bytes = std::max(report.predicted_temp_bytes, labelled->scene.peak_temp_bytes);
  }

  merge::ResultSpool results(folder.path(), inputs.points());
  const bool any_test = plan.method.any_test();  // Without, all points are no contour.
  if (any_test) {
    tiling::TileStore store(folder.path(), plan.survey.lattice, plan.tiles, "");
    MemoryBudget budget(plan.memory.tiles_bytes);
    const TileAnalysis analysis = analysis_of(plan, labelled.get(), results);
    const TileStageResult tiles = run_tile_stage(inputs, plan, analysis, folder.path(), store, budget, sink, cancel);
    report.peak_temp_bytes = std::max({report.peak_temp_bytes, tiles.peak_temp_bytes, folder_bytes(folder.path())});
    watch.lap("tiles");
    const WidenResult widened = run_widen_stage(plan, tiles.unproven, analysis, folder.path(), store, sink, cancel);
    report.isolated = tiles.isolated + widened.isolated;
    report.widened_queries = widened.queries;
    watch.lap("widen");
    for (std::size_t tile = 0; tile < plan.tiles.tiles.size(); ++tile) store.remove(tile);
    release_free_memory();
  }
  gather_points(inputs, request, plan.method, results, writers, report, sink, cancel);
  commit_writers(request, writers, inputs, report, sink);
  watch.lap("write");
  report.cpu_seconds = process_cpu_seconds() - cpu_before;
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

}  // namespace arris::pipeline
