#include "pipeline/extract.h"

#include <sys/resource.h>

#include <chrono>
#include <memory>

#include "core/error.h"
#include "core/memory_budget.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "io/point_source.h"
#include "io/point_writer.h"
#include "merge/result_spool.h"
#include "pipeline/content_hash.h"
#include "pipeline/gather.h"
#include "pipeline/job_plan.h"
#include "pipeline/run_folder.h"
#include "pipeline/tile_stage.h"
#include "pipeline/widen_stage.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(ExtractReport& report) : report_(report) {}
  /// Books the time since the last call on `phase`.
  void lap(const char* phase) {
    const auto now = std::chrono::steady_clock::now();
    report_.seconds.emplace_back(phase, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  ExtractReport& report_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Forwards to the host's sink and keeps the warnings for the report.
class RecordingSink : public ProgressSink {
 public:
  RecordingSink(ProgressSink& host, ExtractReport& report) : host_(host), report_(report) {}
  void phase(std::string_view name, std::uint64_t total_points) override { host_.phase(name, total_points); }
  void advance(std::uint64_t done_points) override { host_.advance(done_points); }
  void note(std::string_view text) override { host_.note(text); }
  void warning(std::string_view code, std::string_view text) override {
    report_.warnings.push_back({std::string(code), std::string(text)});
    host_.warning(code, text);
  }

 private:
  ProgressSink& host_;
  ExtractReport& report_;
};

double process_cpu_seconds() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::uint64_t folder_bytes(const std::filesystem::path& folder) {
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::error_code gone;
    const std::uintmax_t size = entry.file_size(gone);
    if (!gone) bytes += size;
  }
  return bytes;
}

void refuse_bad_outputs(const ExtractRequest& request, const std::vector<std::filesystem::path>& inputs) {
  for (const std::filesystem::path& output : request.outputs) {
    for (const std::filesystem::path& input : inputs) {
      std::error_code missing;
      if (std::filesystem::equivalent(output, input, missing)) {
        throw ConfigError(output.string() + " is an input; choose another output");
      }
    }
  }
}

void warn_of_dropped(const ExtractReport& report, ProgressSink& progress) {
  if (report.dropped_nonfinite > 0) {
    progress.warning("non-finite", std::to_string(report.dropped_nonfinite) +
                                       " points have NaN or infinite coordinates and take no part");
  }
  if (report.dropped_out_of_range > 0) {
    progress.warning("out-of-range",
                     std::to_string(report.dropped_out_of_range) +
                         " points lie outside of what the lattice can hold and take no part; see --lattice");
  }
}

/// Warns of each problem of the inputs once; reading the points may have shown more.
class ProblemWarnings {
 public:
  ProblemWarnings(const io::InputSet& inputs, ProgressSink& progress)
      : inputs_(inputs), progress_(progress), warned_(inputs.sources().size()) {}
  void forward() {
    for (std::size_t i = 0; i < warned_.size(); ++i) {
      const io::SourceInfo& source = inputs_.sources()[i];
      for (; warned_[i] < source.problems.size(); ++warned_[i]) {
        const io::Problem& problem = source.problems[warned_[i]];
        progress_.warning(problem.code, printable(source.path.string()) + ": " + problem.text);
      }
    }
  }

 private:
  const io::InputSet& inputs_;
  ProgressSink& progress_;
  std::vector<std::size_t> warned_;  ///< Per input, problems forwarded.
};

}  // namespace

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

  if (request.hash_inputs) {
    for (InputReport& input : report.inputs) input.hash = content_hash(input.path);
    watch.lap("hash");
  }
  report.cpu_seconds = process_cpu_seconds() - cpu_before;
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

}  // namespace arris::pipeline
