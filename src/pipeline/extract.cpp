#include "pipeline/extract.h"

#include <memory>

#include "core/error.h"
#include "core/memory_budget.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "io/point_source.h"
#include "io/point_writer.h"
#include "merge/result_spool.h"
#include "pipeline/gather.h"
#include "pipeline/job_plan.h"
#include "pipeline/run_folder.h"
#include "pipeline/run_support.h"
#include "pipeline/tile_stage.h"
#include "pipeline/widen_stage.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {

ExtractReport plan_only(const ExtractRequest& request, ProgressSink& progress, const CancelToken& cancel) {
  ExtractReport report;
  RecordingSink sink(progress, report);
  Stopwatch watch(report);
  io::InputSet inputs(io::expand_inputs(request.inputs), request.tolerance);
  inputs.exclude(request.exclusion);
  const JobPlan plan = plan_job(inputs, request, sink, cancel);
  describe_plan(plan, inputs, request, report);
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
  const double cpu_before = process_cpu_seconds();

  const std::vector<std::filesystem::path> paths = io::expand_inputs(request.inputs);
  refuse_bad_outputs(request, paths);
  io::InputSet inputs(paths, request.tolerance);
  ProblemWarnings problems(inputs, sink);
  problems.forward();
  io::OutputOptions output_options;
  output_options.overwrite = request.overwrite;
  output_options.every_point = request.keep_all;
  output_options.mixed_crs = request.mixed_crs;
  std::vector<std::unique_ptr<io::KeptPointWriter>> writers;
  for (const std::filesystem::path& output : request.outputs) {
    writers.push_back(io::create_kept_point_writer(output, inputs, contour_columns(request.refined), output_options));
    report.outputs.push_back(output.string());
  }

  inputs.exclude(request.exclusion);
  const JobPlan plan = plan_job(inputs, request, sink, cancel);
  problems.forward();
  describe_plan(plan, inputs, request, report);
  warn_of_dropped(report, sink);
  watch.lap("survey");

  const RunFolder folder(request.temp_dir);
  merge::ResultSpool results(folder.path(), inputs.points());
  const bool any_test = plan.method.any_test();  // Without, all points are no contour.
  if (any_test) {
    // While tiles run side by side, each has one thread; a lone tile uses them all inside.
    const ThreadLimit limit(request.threads - plan.memory.tile_workers + 1);
    tiling::TileStore store(folder.path(), plan.survey.lattice, plan.tiles, "");
    MemoryBudget budget(plan.memory.tiles_bytes);
    const TileStageResult tiles = run_tile_stage(inputs, plan, folder.path(), store, budget, results, sink, cancel);
    report.peak_temp_bytes = std::max(tiles.spooled_bytes, folder_bytes(folder.path()));
    watch.lap("tiles");
    const WidenResult widened = run_widen_stage(plan, tiles.unproven, folder.path(), store, results, sink, cancel);
    report.isolated = tiles.isolated + widened.isolated;
    report.widened_queries = widened.queries;
    watch.lap("widen");
    for (std::size_t tile = 0; tile < plan.tiles.tiles.size(); ++tile) store.remove(tile);
    release_free_memory();
  }
  gather_points(inputs, request, plan.method, results, writers, report, sink, cancel);
  inputs.check_unchanged();
  for (const auto& writer : writers) {
    writer->commit();
    for (const std::string& warning : writer->warnings()) sink.warning("not-carried", warning);
  }
  watch.lap("write");

  hash_inputs(request, report);
  if (request.hash_inputs) watch.lap("hash");
  report.cpu_seconds = process_cpu_seconds() - cpu_before;
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

}  // namespace arris::pipeline
