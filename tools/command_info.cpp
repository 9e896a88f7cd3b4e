/// @file arris info.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "common_options.h"
#include "core/text.h"
#include "io/file_summary.h"
#include "tiling/survey.h"

namespace arris::tools {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::vector<std::string> inputs;
  bool json = false;
  ToleranceOptions tolerance;
  DisplayOptions display;
};

/// What reading the points shows.
struct Counted {
  std::uint64_t points = 0;
  std::uint64_t non_finite = 0;
  std::array<double, 3> min{};
  std::array<double, 3> max{};
  double spacing = 0.0;
};

Counted count_points(const std::filesystem::path& path, io::Tolerance tolerance, ProgressSink& progress,
                     const CancelToken& cancel) {
  io::InputSet inputs({path}, tolerance);
  const tiling::Survey survey = tiling::survey_inputs(inputs, {}, progress, cancel);
  Counted counted;
  counted.points = survey.points_in;
  counted.non_finite = survey.dropped_nonfinite;
  counted.spacing = survey.spacing;
  if (!survey.bounds.empty()) {
    for (int axis = 0; axis < 3; ++axis) {
      counted.min[axis] = survey.lattice.world(axis, survey.bounds.min[axis]);
      counted.max[axis] = survey.lattice.world(axis, survey.bounds.max[axis] - 1);
    }
  }
  return counted;
}

/// A header box that differs from the points by more than rounding.
bool box_is_wrong(const io::FileSummary& file, const Counted& counted) {
  if (!file.claimed_bounds || counted.points == counted.non_finite) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const double slack = 1.01 * std::abs(file.info.scale[axis]);
    if (!(std::abs(file.claimed_bounds->min[axis] - counted.min[axis]) <= slack) ||
        !(std::abs(file.claimed_bounds->max[axis] - counted.max[axis]) <= slack)) {
      return true;
    }
  }
  return false;
}

Json to_json(const io::FileSummary& file, const Counted& counted) {
  Json json{{"path", printable(file.info.path.string(), 4096)},
            {"layout", file.info.layout},
            {"bytes", file.info.size_bytes},
            {"points", counted.points},
            {"non_finite", counted.non_finite},
            {"min", counted.min},
            {"max", counted.max},
            {"spacing", counted.spacing},
            {"crs", {{"name", file.crs.name}, {"unit", file.crs.unit}, {"text", file.crs.text}}}};
  json["header"] = Json::object();
  for (const auto& [name, value] : file.header) json["header"][name] = value;
  if (file.claimed_bounds)
    json["claimed_bounds"] = {{"min", file.claimed_bounds->min}, {"max", file.claimed_bounds->max}};
  json["records"] = Json::array();
  for (const io::RecordSummary& r : file.records) {
    json["records"].push_back({{"user_id", r.user_id},
                               {"record_id", r.record_id},
                               {"description", r.description},
                               {"length", r.length},
                               {"extended", r.extended}});
  }
  json["attributes"] = Json::array();
  for (const io::AttributeSummary& a : file.attributes)
    json["attributes"].push_back({{"name", a.name}, {"type", a.type}, {"description", a.description}});
  json["problems"] = Json::array();
  for (const io::Problem& p : file.problems) json["problems"].push_back({{"code", p.code}, {"text", p.text}});
  return json;
}

std::string to_text(const io::FileSummary& file, const Counted& counted) {
  std::string text = fmt::format("{}\n  {}, {}\n  points   {}", printable(file.info.path.string(), 4096),
                                 file.info.layout, human_bytes(file.info.size_bytes), grouped(counted.points));
  if (counted.non_finite > 0) text += fmt::format(" ({} without a position)", grouped(counted.non_finite));
  text += "\n";
  if (counted.points > counted.non_finite) {
    text += fmt::format("  min      {:.10g} {:.10g} {:.10g}\n", counted.min[0], counted.min[1], counted.min[2]);
    text += fmt::format("  max      {:.10g} {:.10g} {:.10g}\n", counted.max[0], counted.max[1], counted.max[2]);
    text += fmt::format("  spacing  about {:.3g}\n", counted.spacing);
  }
  if (!file.crs.name.empty())
    text += fmt::format("  crs      {}{}\n", file.crs.name, file.crs.unit.empty() ? "" : ", unit " + file.crs.unit);
  for (const auto& [name, value] : file.header) text += fmt::format("  {:<24} {}\n", name, value);
  for (const io::AttributeSummary& a : file.attributes) {
    text += fmt::format("  attribute {} ({}){}\n", a.name, a.type, a.description.empty() ? "" : ": " + a.description);
  }
  for (const io::RecordSummary& r : file.records) {
    text += fmt::format("  record   {} {} ({} bytes){}\n", r.user_id, r.record_id, r.length,
                        r.description.empty() ? "" : ": " + r.description);
  }
  for (const io::Problem& p : file.problems) text += fmt::format("  problem  {} [{}]\n", p.text, p.code);
  return text;
}

int run_info(const InfoOptions& o, Session& session) {
  ProgressDisplay display(o.display.mode(), o.display.verbosity());
  Json json{{"schema", "arris-info/1"}, {"files", Json::array()}};
  std::string text;
  for (const std::filesystem::path& path : io::expand_inputs(o.inputs)) {
    io::FileSummary file = io::summarize_file(path, o.tolerance.tolerance());
    const Counted counted = count_points(path, o.tolerance.tolerance(), display, session.cancel);
    if (box_is_wrong(file, counted))
      file.problems.push_back({"bbox-mismatch", "the bounding box in the header is not that of the points"});
    if (o.json) {
      json["files"].push_back(to_json(file, counted));
    } else {
      text += to_text(file, counted);
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
  add_tolerance_options(*verb, o->tolerance);
  add_display_options(*verb, o->display);
  verb->callback([o, &session] { session.run = [o, &session] { return run_info(*o, session); }; });
}

}  // namespace arris::tools
