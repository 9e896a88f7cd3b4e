/// @file arris plan: what a job would do.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/text.h"
#include "job_options.h"
#include "pipeline/extract.h"
#include "segment_job_options.h"
#include "supervoxel_job_options.h"

namespace arris::tools {
namespace {

/// Points per second and thread of whole jobs, for the time that a plan states; see bench/README.md.
constexpr double kExtractPointsPerThreadSecond = 400e3;
constexpr double kSegmentPointsPerThreadSecond = 700e3;
constexpr double kSupervoxelPointsPerThreadSecond = 2e6;

std::string describe_inputs(const pipeline::RunReport& r) {
  std::string text;
  for (const pipeline::InputReport& input : r.inputs) {
    text += fmt::format("{}: {} points, {}\n", printable(input.path), grouped(input.points), input.layout);
  }
  text += fmt::format("points            {}\n", grouped(r.points_in));
  return text + fmt::format("spacing           about {:.4g}\n", r.spacing);
}

std::string describe_costs(const pipeline::RunReport& r, double points_per_thread_second,
                           const std::string& memory_why) {
  const double seconds = static_cast<double>(r.points_in) / (points_per_thread_second * r.threads);
  return fmt::format(
      "peak memory       {} predicted of {} ({})\n"
      "temporary files   {} predicted\n"
      "time              about {:.0f} s on {} threads (rough)\n",
      human_bytes(r.predicted_peak_bytes), human_bytes(r.memory_budget_bytes), memory_why,
      human_bytes(r.predicted_temp_bytes), seconds, r.threads);
}

std::string describe(const pipeline::TiledReport& r, double search_limit, double points_per_thread_second,
                     const std::string& memory_why) {
  std::string text = describe_inputs(r);
  text += fmt::format("search limit      {:.4g}\n", search_limit);
  text += fmt::format("tiles             {} of at most {} points (limit {}), {} in flight\n", grouped(r.tiles),
                      grouped(r.largest_tile_points), grouped(r.tile_points_limit), r.tile_workers);
  text += fmt::format("halo              {:.4g} to {:.4g}; {:.2f} copies of each point\n", r.least_halo, r.widest_halo,
                      r.duplication);
  return text + describe_costs(r, points_per_thread_second, memory_why);
}

struct ExtractPlan {
  JobOptions job;
  bool json = false;
};

int run(ExtractPlan& o, const CLI::App& verb, Session& session) {
  const pipeline::ExtractRequest request = to_request(o.job, verb);
  ProgressDisplay display(o.job.run.display.mode(), o.job.run.display.verbosity());
  const pipeline::ExtractReport report = pipeline::plan_only(request, display, session.cancel);
  display.finish();
  write_text(
      "-",
      o.json ? to_json(report).dump(2) + "\n"
             : describe(report, report.parameters.max_radius(), kExtractPointsPerThreadSecond, o.job.run.memory_why),
      false);
  return 0;
}

struct SegmentPlan {
  SegmentJobOptions job;
  bool json = false;
};

int run(SegmentPlan& o, Session& session) {
  const pipeline::SegmentRequest request = to_request(o.job);
  ProgressDisplay display(o.job.run.display.mode(), o.job.run.display.verbosity());
  const pipeline::SegmentReport report = pipeline::plan_segments(request, display, session.cancel);
  display.finish();
  write_text("-",
             o.json
                 ? to_json(report).dump(2) + "\n"
                 : describe(report, report.parameters.max_radius, kSegmentPointsPerThreadSecond, o.job.run.memory_why),
             false);
  return 0;
}

struct SupervoxelPlan {
  SupervoxelJobOptions job;
  bool json = false;
};

int run(SupervoxelPlan& o, Session& session) {
  const pipeline::SupervoxelRequest request = to_request(o.job);
  ProgressDisplay display(o.job.run.display.mode(), o.job.run.display.verbosity());
  const pipeline::SupervoxelReport report = pipeline::plan_supervoxels(request, display, session.cancel);
  display.finish();
  const std::string text =
      describe_inputs(report) +
      fmt::format("voxels            about {} of {:.4g}\n", grouped(report.voxels), report.parameters.voxel) +
      describe_costs(report, kSupervoxelPointsPerThreadSecond, o.job.run.memory_why);
  write_text("-", o.json ? to_json(report).dump(2) + "\n" : text, false);
  return 0;
}

void add_extract_plan(CLI::App& verb, Session& session) {
  auto options = std::make_shared<ExtractPlan>();
  add_job_options(verb, options->job);
  verb.add_flag("--json", options->json, "As JSON");
  verb.callback([options, &verb, &session] {
    if (!verb.get_subcommands().empty()) return;  // That one has said what to run.
    session.run = [options, &verb, &session] { return run(*options, verb, session); };
  });
}

/// @param add_options  of the job that is planned.
template <class Plan, class Job>
void add_plan_of(CLI::App& verb, void (*add_options)(CLI::App&, Job&), Session& session) {
  auto options = std::make_shared<Plan>();
  add_options(verb, options->job);
  verb.add_flag("--json", options->json, "As JSON");
  verb.callback([options, &session] { session.run = [options, &session] { return run(*options, session); }; });
}

}  // namespace

void add_plan(CLI::App& app, Session& session) {
  CLI::App* verb = app.add_subcommand("plan",
                                      "What a job would do: tiles, memory, disk; touches nothing. 'plan IN' is of "
                                      "extract, 'plan segment IN' of segment, 'plan supervoxel IN' of supervoxel");
  add_extract_plan(*verb, session);
  verb->get_option("inputs")->required(false);  // Not those of the verbs below; none at all is refused as bad input.
  verb->require_subcommand(0, 1);
  add_plan_of<SegmentPlan>(*verb->add_subcommand("segment", "What segment would do (contours and outlines left out)"),
                           add_segment_job_options, session);
  add_plan_of<SupervoxelPlan>(*verb->add_subcommand("supervoxel", "What supervoxel would do, without colours"),
                              add_supervoxel_job_options, session);
}

}  // namespace arris::tools
