#pragma once
/// @file What all jobs need around their work: clocks, warnings, checks of outputs.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/columns.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "io/point_writer.h"
#include "pipeline/run_report.h"
#include "pipeline/run_request.h"
#include "tiling/survey.h"

namespace arris::pipeline {

class Stopwatch {
 public:
  explicit Stopwatch(RunReport& report) : report_(report) {}
  /// Books the time since the last call on `phase`.
  void lap(const char* phase);

 private:
  RunReport& report_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Forwards to the host's sink and keeps the warnings for the report.
class RecordingSink : public ProgressSink {
 public:
  RecordingSink(ProgressSink& host, RunReport& report) : host_(host), report_(report) {}
  void phase(std::string_view name, std::uint64_t total_points) override { host_.phase(name, total_points); }
  void advance(std::uint64_t done_points) override { host_.advance(done_points); }
  void note(std::string_view text) override { host_.note(text); }
  void warning(std::string_view code, std::string_view text) override {
    report_.warnings.push_back({std::string(code), std::string(text)});
    host_.warning(code, text);
  }

 private:
  ProgressSink& host_;
  RunReport& report_;
};

/// Warns of each problem of the inputs once; reading the points may have shown more.
class ProblemWarnings {
 public:
  ProblemWarnings(const io::InputSet& inputs, ProgressSink& progress)
      : inputs_(inputs), progress_(progress), warned_(inputs.sources().size()) {}
  void forward();

 private:
  const io::InputSet& inputs_;
  ProgressSink& progress_;
  std::vector<std::size_t> warned_;  ///< Per input, problems forwarded.
};

double process_cpu_seconds();
/// Sum of the sizes of the files in a folder, not recursive.
std::uint64_t folder_bytes(const std::filesystem::path& folder);
/// Throws ConfigError if an output is an input.
void refuse_bad_outputs(const RunRequest& request, const std::vector<std::filesystem::path>& inputs);
void describe_inputs(const tiling::Survey& survey, const io::InputSet& inputs, const RunRequest& request,
                     RunReport& report);
void warn_of_dropped(const RunReport& report, ProgressSink& progress);
/// Throws BudgetError if temporary files of that size do not fit where the request wants them; warns if that is memory.
void check_temp_space(std::uint64_t predicted_bytes, const RunRequest& request, ProgressSink& progress);
using Writers = std::vector<std::unique_ptr<io::KeptPointWriter>>;
/// One writer per output, named in the report. @param every_point  all points of the inputs will be written.
Writers open_writers(const RunRequest& request, const io::InputSet& inputs, const std::vector<ColumnSpec>& columns,
                     bool every_point, RunReport& report);
/// Makes the outputs appear, if the inputs are still what they were; forwards what the writers could not carry. Puts
/// hashes of the inputs into the report, if asked for: they are computed while the disk takes the outputs in.
void commit_writers(const RunRequest& request, const Writers& writers, const io::InputSet& inputs, RunReport& report,
                    ProgressSink& progress);

}  // namespace arris::pipeline
