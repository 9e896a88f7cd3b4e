/// @file arris info.

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "common_options.h"
#include "info_report.h"
#include "tiling/survey.h"

namespace arris::tools {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::vector<std::string> inputs;
  bool json = false;
  bool header_only = false;
  ToleranceOptions tolerance;
  DisplayOptions display;
};

/// Reads the points twice: for what they hold, and for their spacing.
void read_points(InfoReport& report, ProgressSink& progress, const CancelToken& cancel) {
  const io::SourceInfo& info = report.file.info;
  const auto file = std::make_shared<const io::InputFile>(info.path);
  const auto source = io::open_point_source(file, info.tolerance);
  const auto reader = io::make_record_reader(*file, info);
  progress.phase("read", info.points);
  report.points = io::collect_statistics(*source, *reader, [&](std::uint64_t points) {
    cancel.check();
    progress.advance(points);
  });
  const std::vector<io::Problem>& all = source->info().problems;  // Some show only when points are read.
  report.file.problems.insert(report.file.problems.end(),
                              all.begin() + static_cast<std::ptrdiff_t>(info.problems.size()), all.end());
  for (io::Problem& problem : io::find_point_problems(*file, info, *report.points))
    report.file.problems.push_back(std::move(problem));
  io::InputSet inputs({info.path}, info.tolerance);
  report.spacing = tiling::survey_inputs(inputs, {}, progress, cancel).spacing;
}

int run_info(const InfoOptions& o, Session& session) {
  ProgressDisplay display(o.display.mode(), o.display.verbosity());
  Json json{{"schema", "arris-info/1"}, {"files", Json::array()}};
  std::string text;
  for (const std::filesystem::path& path : io::expand_inputs(o.inputs)) {
    InfoReport report{io::summarize_file(path, o.tolerance.tolerance()), {}, 0.0};
    if (!o.header_only) read_points(report, display, session.cancel);
    if (o.json) {
      json["files"].push_back(to_json(report));
    } else {
      text += to_text(report);
    }
  }
  display.finish();
  write_text("-", o.json ? json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n" : text, false);
  return 0;
}

}  // namespace

void add_info(CLI::App& app, Session& session) {
  auto o = std::make_shared<InfoOptions>();
  CLI::App* verb = app.add_subcommand("info", "What files hold: header, counts, extent, spacing, attributes, problems");
  verb->add_option("inputs", o->inputs, "LAS and PLY files, or folders of them")->required();
  verb->add_flag("--json", o->json, "As JSON");
  verb->add_flag("--header", o->header_only, "Show what the file says of itself, without reading its points");
  add_tolerance_options(*verb, o->tolerance);
  add_display_options(*verb, o->display);
  verb->callback([o, &session] { session.run = [o, &session] { return run_info(*o, session); }; });
}

}  // namespace arris::tools
