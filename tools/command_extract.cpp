/// @file arris extract.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/text.h"
#include "job_options.h"
#include "pipeline/extract.h"

namespace arris::tools {
namespace {

struct ExtractOptions {
  JobOptions job;
  std::vector<std::string> outputs;
  std::string report;
  bool overwrite = false;
  bool keep_all = false;
  bool mixed_crs = false;
  bool refined = false;
};

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "0 %" : fmt::format("{:.2f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

/// What sets the scale of the chosen method.
std::string describe_scale(const pipeline::ExtractReport& r) {
  const ContourParameters& p = r.parameters;
  if (p.method == ContourParameters::Method::kArris) return "ball radius 5 to 13 local spacings";
  if (p.method == ContourParameters::Method::kZheng) {
    return fmt::format("voxels {:.4g}, seeds {:.4g}, {} supervoxels", p.supervoxel.voxel, p.supervoxel.seed,
                       grouped(r.supervoxels));
  }
  return p.liu.radius > 0.0 ? fmt::format("ball radius {:.6g}", p.liu.radius)
                            : fmt::format("ball radius {:g} local spacings", p.liu.radius_factor);
}

std::string describe_choices(const pipeline::ExtractReport& r, const std::string& memory_why) {
  return fmt::format(
      "method {}, spacing about {:.4g}, {}, search limit {:.4g}; lattice step {:g}\n"
      "memory {} ({}), {} threads; {} tiles of at most {} points, halo {:.3g} to {:.3g}",
      r.parameters.name(), r.spacing, describe_scale(r), r.parameters.max_radius(), r.lattice.step,
      human_bytes(r.memory_budget_bytes), memory_why, r.threads, grouped(r.tiles), grouped(r.tile_points_limit),
      r.least_halo, r.widest_halo);
}

std::string describe_result(const pipeline::ExtractReport& r) {
  double seconds = 0.0;
  for (const auto& [phase, s] : r.seconds) seconds += s;
  std::string text = fmt::format("{} points in, {} out ({}): {} boundary, {} weak boundary, {} fold\n",
                                 grouped(r.points_in), grouped(r.points_out), percent(r.points_out, r.points_in),
                                 grouped(r.boundary), grouped(r.weak_boundary), grouped(r.fold));
  text += fmt::format("{:.1f} s, {:.1f} CPU s, peak memory {} of {}", seconds, r.cpu_seconds,
                      human_bytes(r.peak_resident_bytes), human_bytes(r.memory_budget_bytes));
  for (const std::string& output : r.outputs) text += "\nwrote " + printable(output);
  return text;
}

int run_extract(ExtractOptions& o, const CLI::App& verb, Session& session) {
  pipeline::ExtractRequest request = to_request(o.job, verb);
  request.outputs.assign(o.outputs.begin(), o.outputs.end());
  request.overwrite = o.overwrite;
  request.keep_all = o.keep_all;
  request.mixed_crs = o.mixed_crs;
  request.refined = o.refined;
  request.hash_inputs = !o.report.empty();
  ProgressDisplay display(o.job.run.display.mode(), o.job.run.display.verbosity());
  const pipeline::ExtractReport report = pipeline::extract(request, display, session.cancel);
  display.finish();
  display.note(describe_choices(report, o.job.run.memory_why));
  display.note(describe_result(report));
  if (!o.report.empty()) write_text(o.report, to_json(report).dump(2) + "\n", o.overwrite);
  return 0;
}

}  // namespace

void add_extract(CLI::App& app, Session& session) {
  auto options = std::make_shared<ExtractOptions>();
  CLI::App* verb = app.add_subcommand("extract", "Contour points: boundaries and folds");
  add_job_options(*verb, options->job);
  verb->add_option("-o,--output", options->outputs, "Output, .las or .ply; may be given several times")
      ->required()
      ->take_all();
  verb->add_option("--report", options->report, "Write what was done as JSON");
  verb->add_flag("--overwrite", options->overwrite, "Replace existing outputs");
  verb->add_flag("--refined", options->refined,
                 "Add EdgeX, EdgeY, EdgeZ: the way from the point to the refined edge (method arris)");
  verb->add_flag("--keep-all", options->keep_all, "Write every point, with EdgeClass 0 where it is no contour point");
  verb->add_flag("--mixed-crs", options->mixed_crs,
                 "Allow inputs with different coordinate reference systems in one output");
  verb->callback([options, verb, &session] {
    session.run = [options, verb, &session] { return run_extract(*options, *verb, session); };
  });
}

}  // namespace arris::tools
