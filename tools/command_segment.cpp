/// @file arris segment.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/text.h"
#include "pipeline/segment.h"
#include "segment_job_options.h"

namespace arris::tools {
namespace {

struct SegmentCommand {
  SegmentJobOptions job;
  std::vector<std::string> outputs;
  std::string table, outlines;
  std::string report;
  bool overwrite = false;
  bool mixed_crs = false;
};

std::string describe_neighbours(const SegmentParameters& p) {
  if (p.radius > 0.0) return fmt::format("neighbours within {:.4g}", p.radius);
  if (p.adaptive() && p.most_by_noise > kFewestNeighbours)
    return fmt::format("{} to {} neighbours (noise {:.2g})", kFewestNeighbours, p.most_by_noise, p.noise);
  return fmt::format("{} neighbours", p.most_neighbours());
}

std::string describe_segments(const pipeline::SegmentReport& r, const std::string& memory_why) {
  double seconds = 0.0;
  for (const auto& [phase, s] : r.seconds) seconds += s;
  std::string text = fmt::format(
      "{}, angle {:g} degrees{}; spacing about {:.4g}, lattice step {:g}\n"
      "memory {} ({}), {} threads; {} tiles of at most {} points\n"
      "{} points, {} segments with {} points\n"
      "{:.1f} s, {:.1f} CPU s, peak memory {} of {}",
      describe_neighbours(r.parameters), r.parameters.angle_deg, r.parameters.published ? ", as published" : "",
      r.spacing, r.lattice.step, human_bytes(r.memory_budget_bytes), memory_why, r.threads, grouped(r.tiles),
      grouped(r.largest_tile_points), grouped(r.points_in), grouped(r.segments), grouped(r.labelled), seconds,
      r.cpu_seconds, human_bytes(r.peak_resident_bytes), human_bytes(r.memory_budget_bytes));
  for (const std::string& output : r.outputs) text += "\nwrote " + printable(output);
  return text;
}

int run_segment(SegmentCommand& o, Session& session) {
  pipeline::SegmentRequest request = to_request(o.job);
  request.outputs.assign(o.outputs.begin(), o.outputs.end());
  request.overwrite = o.overwrite;
  request.mixed_crs = o.mixed_crs;
  request.hash_inputs = !o.report.empty();
  request.table = o.table;
  request.outlines = o.outlines;
  ProgressDisplay display(o.job.run.display.mode(), o.job.run.display.verbosity());
  const pipeline::SegmentReport report = pipeline::segment(request, display, session.cancel);
  display.finish();
  display.note(describe_segments(report, o.job.run.memory_why));
  if (!o.report.empty()) write_text(o.report, to_json(report).dump(2) + "\n", o.overwrite);
  return 0;
}

}  // namespace

void add_segment(CLI::App& app, Session& session) {
  auto options = std::make_shared<SegmentCommand>();
  CLI::App* verb =
      app.add_subcommand("segment", "Planar segments of roofs and facades: every point gets the id of its own");
  add_segment_job_options(*verb, options->job);
  verb->add_option("-o,--output", options->outputs, "Output, .las or .ply; may be given several times")
      ->required()
      ->take_all();
  verb->add_option("--table", options->table, "Write a line per segment with its plane: .csv or .json");
  verb->add_option("--outlines", options->outlines, "Write the outlines of the segments as polygons: .gpkg or .obj");
  verb->add_option("--report", options->report, "Write what was done as JSON");
  verb->add_flag("--overwrite", options->overwrite, "Replace existing outputs");
  verb->add_flag("--mixed-crs", options->mixed_crs,
                 "Allow inputs with different coordinate reference systems in one output");
  verb->callback([options, &session] { session.run = [options, &session] { return run_segment(*options, session); }; });
}

}  // namespace arris::tools
