/// @file arris supervoxel.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/text.h"
#include "pipeline/supervoxel.h"
#include "supervoxel_job_options.h"

namespace arris::tools {
namespace {

struct SupervoxelCommand {
  SupervoxelJobOptions job;
  std::vector<std::string> outputs;
  std::string table;
  std::string adjacency;
  std::string report;
  bool overwrite = false;
  bool mixed_crs = false;
};

std::string describe_supervoxels(const pipeline::SupervoxelReport& r, const std::string& memory_why) {
  const bool fpfh = r.parameters.features == SupervoxelParameters::Features::kFpfh;
  double seconds = 0.0;
  for (const auto& [phase, s] : r.seconds) seconds += s;
  std::string text = fmt::format(
      "voxels {:.4g}, seeds {:.4g}, features {}{}; spacing about {:.4g}, lattice step {:g}\n"
      "memory {} ({}), {} threads; {} tiles of at most {} voxels\n"
      "{} points, {} voxels, {} supervoxels ({} on coarser voxels)\n"
      "{:.1f} s, {:.1f} CPU s, peak memory {} of {}",
      r.parameters.voxel, r.parameters.seed, fpfh ? "fpfh" : "normal", r.colours ? " with colour" : "", r.spacing,
      r.lattice.step, human_bytes(r.memory_budget_bytes), memory_why, r.threads, grouped(r.tiles),
      grouped(r.largest_tile_voxels), grouped(r.points_in), grouped(r.voxels), grouped(r.supervoxels),
      grouped(r.coarse), seconds, r.cpu_seconds, human_bytes(r.peak_resident_bytes),
      human_bytes(r.memory_budget_bytes));
  for (const std::string& output : r.outputs) text += "\nwrote " + printable(output);
  return text;
}

int run_supervoxel(SupervoxelCommand& o, Session& session) {
  pipeline::SupervoxelRequest request = to_request(o.job);
  request.outputs.assign(o.outputs.begin(), o.outputs.end());
  request.overwrite = o.overwrite;
  request.mixed_crs = o.mixed_crs;
  request.hash_inputs = !o.report.empty();
  request.table = o.table;
  request.adjacency = o.adjacency;
  ProgressDisplay display(o.job.run.display.mode(), o.job.run.display.verbosity());
  const pipeline::SupervoxelReport report = pipeline::label_supervoxels(request, display, session.cancel);
  display.finish();
  display.note(describe_supervoxels(report, o.job.run.memory_why));
  if (!o.report.empty()) write_text(o.report, to_json(report).dump(2) + "\n", o.overwrite);
  return 0;
}

}  // namespace

void add_supervoxel(CLI::App& app, Session& session) {
  auto options = std::make_shared<SupervoxelCommand>();
  CLI::App* verb = app.add_subcommand("supervoxel", "Supervoxels: every point gets the id of the one it belongs to");
  add_supervoxel_job_options(*verb, options->job);
  verb->add_option("-o,--output", options->outputs, "Output, .las or .ply; may be given several times")
      ->required()
      ->take_all();
  verb->add_option("--table", options->table, "Write a line per supervoxel: .csv or .json");
  verb->add_option("--adjacency", options->adjacency, "Write which supervoxels touch: .csv or .json");
  verb->add_option("--report", options->report, "Write what was done as JSON");
  verb->add_flag("--overwrite", options->overwrite, "Replace existing outputs");
  verb->add_flag("--mixed-crs", options->mixed_crs,
                 "Allow inputs with different coordinate reference systems in one output");
  verb->callback(
      [options, &session] { session.run = [options, &session] { return run_supervoxel(*options, session); }; });
}

}  // namespace arris::tools
