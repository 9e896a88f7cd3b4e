#include "pipeline/run_support.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "pipeline/content_hash.h"
#include "pipeline/run_folder.h"

namespace arris::pipeline {

void Stopwatch::lap(const char* phase) {
  const auto now = std::chrono::steady_clock::now();
  report_.seconds.emplace_back(phase, std::chrono::duration<double>(now - last_).count());
  last_ = now;
}

void ProblemWarnings::forward() {
  for (std::size_t i = 0; i < warned_.size(); ++i) {
    const io::SourceInfo& source = inputs_.sources()[i];
    for (; warned_[i] < source.problems.size(); ++warned_[i]) {
      const io::Problem& problem = source.problems[warned_[i]];
      progress_.warning(problem.code, printable(source.path.string()) + ": " + problem.text);
    }
  }
}

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

void refuse_bad_outputs(const RunRequest& request, const std::vector<std::filesystem::path>& inputs) {
  for (const std::filesystem::path& output : request.outputs) {
    for (const std::filesystem::path& input : inputs) {
      std::error_code missing;
      if (std::filesystem::equivalent(output, input, missing)) {
        throw ConfigError(output.string() + " is an input; choose another output");
      }
    }
  }
}

void describe_inputs(const tiling::Survey& survey, const io::InputSet& inputs, const RunRequest& request,
                     RunReport& report) {
  report.lattice = survey.lattice;
  report.bounds = survey.bounds;
  report.spacing = survey.spacing;
  for (const io::SourceInfo& source : inputs.sources()) {
    report.inputs.push_back({source.path.string(), source.layout, source.points, source.size_bytes, ""});
  }
  report.points_in = survey.points_in;
  report.dropped_nonfinite = survey.dropped_nonfinite;
  report.dropped_out_of_range = survey.dropped_out_of_range;
  report.dropped_excluded = survey.dropped_excluded;
  report.threads = request.threads;
  report.memory_budget_bytes = request.memory_bytes;
}

void warn_of_dropped(const RunReport& report, ProgressSink& progress) {
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

void check_temp_space(std::uint64_t predicted_bytes, const RunRequest& request, ProgressSink& progress) {
  const TempSpace space = temp_space(request.temp_dir);
  const std::uint64_t limit =
      request.max_temp_bytes > 0 ? std::min(request.max_temp_bytes, space.free_bytes) : space.free_bytes;
  if (predicted_bytes > limit) {
    throw BudgetError(fmt::format(
        "temporary files need about {} but {} allows {}; free space, raise --max-temp or choose another --temp-dir",
        human_bytes(predicted_bytes), request.temp_dir.string(), human_bytes(limit)));
  }
  if (space.in_memory) {
    progress.warning("temp-in-memory",
                     fmt::format("{} is a file system in memory: temporary files count as memory; choose "
                                 "another --temp-dir",
                                 request.temp_dir.string()));
  }
}

Writers open_writers(const RunRequest& request, const io::InputSet& inputs, const std::vector<ColumnSpec>& columns,
                     bool every_point, RunReport& report) {
  io::OutputOptions options;
  options.overwrite = request.overwrite;
  options.every_point = every_point;
  options.mixed_crs = request.mixed_crs;
  Writers writers;
  for (const std::filesystem::path& output : request.outputs) {
    writers.push_back(io::create_kept_point_writer(output, inputs, columns, options));
    report.outputs.push_back(output.string());
  }
  return writers;
}

void commit_writers(const RunRequest& request, const Writers& writers, const io::InputSet& inputs, RunReport& report,
                    ProgressSink& progress) {
  inputs.check_unchanged();
  const auto hash_inputs = [&] {
    if (!request.hash_inputs) return;
    for (InputReport& input : report.inputs) input.hash = content_hash(input.path);
  };
  BackgroundTasks hashing(1);
  if (loop_threads() > 1) hashing.run(hash_inputs);
  for (const auto& writer : writers) {
    writer->commit();
    for (const std::string& warning : writer->warnings()) progress.warning("not-carried", warning);
  }
  if (loop_threads() > 1) {
    hashing.wait();
  } else {
    hash_inputs();
  }
}

}  // namespace arris::pipeline
