/// @file arris synth.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "commands.h"
#include "common_options.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "core/units.h"
#include "evaluate/segmentation_comparison.h"
#include "evaluate/truth.h"
#include "io/point_writer.h"
#include "synth/scene.h"

namespace arris::tools {
namespace {

struct SynthOptions {
  synth::SceneRequest request;
  std::string output;
  std::string truth;
  std::string truth_of = "scan";
  std::string spacing, noise, scale;
  std::vector<double> shift;
  std::vector<std::string> options;
  int threads = 0;
  bool labels = false;
  bool overwrite = false;
  DisplayOptions display;
};

std::string scene_list() {
  std::string text = "Scenes:\n";
  for (const synth::SceneInfo& scene : synth::list_scenes()) {
    text += fmt::format("  {:<10} {} (spacing {:g})\n", scene.name, scene.description, scene.spacing);
    for (const synth::SceneOption& option : scene.options) {
      text += fmt::format("             --set {}={:g}  {}\n", option.name, option.value, option.description);
    }
  }
  return text;
}

void parse_settings(const std::vector<std::string>& settings, std::map<std::string, double>& options) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    double value = 0.0;
    const char* end = setting.data() + setting.size();
    if (equals == std::string::npos || std::from_chars(setting.data() + equals + 1, end, value).ptr != end ||
        equals + 1 == setting.size()) {
      throw ConfigError(fmt::format("--set '{}' is not NAME=NUMBER", printable(setting, 60)));
    }
    options[setting.substr(0, equals)] = value;
  }
}

/// A LAS scale fine against spacing and noise, a power of ten, that holds the scene's extent in int32.
double choose_scale(const synth::Scene& scene, double noise) {
  const double fine = noise > 0.0 ? std::min(scene.spacing() / 100.0, noise / 10.0) : scene.spacing() / 100.0;
  const auto box = scene.bounds();
  double extent = 0.0;
  for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, box[1][axis] - box[0][axis]);
  const double coarse_enough = extent / 1e9;
  return std::pow(10.0, std::floor(std::log10(std::clamp(std::max(fine, coarse_enough), 1e-6, 1e-3))));
}

int run_synth(SynthOptions& o, Session& session) {
  if (!o.spacing.empty()) o.request.spacing = parse_length(o.spacing);
  if (!o.noise.empty()) o.request.noise = parse_length(o.noise);
  if (!o.shift.empty()) std::copy_n(o.shift.begin(), 3, o.request.shift.begin());
  parse_settings(o.options, o.request.options);
  const synth::Scene scene(o.request);
  io::FreshCloud cloud;
  cloud.scale = o.scale.empty() ? choose_scale(scene, o.request.noise) : parse_length(o.scale);
  for (int axis = 0; axis < 3; ++axis) cloud.offset[axis] = std::floor(scene.bounds()[0][axis]);
  cloud.generator = "arris synth";
  if (o.labels) cloud.label = ColumnSpec{std::string(evaluate::kFaceColumn), ColumnType::kUint32, "surface; 0: none"};

  const ThreadLimit limit(resolve_threads(o.threads));
  ProgressDisplay display(o.display.mode(), o.display.verbosity());
  const auto writer = io::create_fresh_cloud_writer(o.output, cloud, {o.overwrite});
  if (!o.truth.empty() && !o.overwrite && std::filesystem::exists(o.truth)) {
    throw ConfigError(printable(o.truth) + " exists; choose another name or add --overwrite");
  }
  display.phase("synth", static_cast<std::uint64_t>(scene.expected_points()));
  const auto stream = scene.stream();
  std::uint64_t points = 0;
  for (std::vector<io::FreshPoint> block; stream->next(block);) {
    session.cancel.check();
    writer->append(block);
    points += block.size();
    display.advance(block.size());
  }
  const synth::TruthOf of = o.truth_of == "model" ? synth::TruthOf::kModel : synth::TruthOf::kScan;
  if (!o.truth.empty()) evaluate::write_truth_csv(std::filesystem::path(o.truth), scene.truth(of), o.overwrite);
  writer->commit();
  display.finish();
  display.note(fmt::format("{}: {} points, spacing {:.4g}; wrote {}", o.request.scene, grouped(points), scene.spacing(),
                           printable(o.output)));
  return 0;
}

}  // namespace

void add_synth(CLI::App& app, Session& session) {
  auto o = std::make_shared<SynthOptions>();
  CLI::App* verb = app.add_subcommand("synth", "Make a scene with exact truth");
  verb->footer(scene_list());
  verb->add_option("scene", o->request.scene, "Scene, see below")->required();
  verb->add_option("-o,--output", o->output, "Output, .las or .ply")->required();
  verb->add_option("--truth", o->truth, "Write the scene's edges as CSV");
  verb->add_option("--truth-of", o->truth_of,
                   "Scanned scenes: scan, the contours that the points show (with the spacing beside each), or model, "
                   "all edges of the model")
      ->check(CLI::IsMember({"scan", "model"}))
      ->capture_default_str();
  verb->add_flag("--labels", o->labels,
                 "Write the number of the surface that each point lies on as well, as column FaceId (0: none)");
  verb->add_option("--points", o->request.points, "About so many points (instead of --spacing)");
  verb->add_option("--spacing", o->spacing, "Point spacing (length)");
  verb->add_option("--noise", o->noise, "Standard deviation of the noise (length); scanned scenes: along the ray");
  verb->add_option("--sampling", o->request.sampling, "Of surface scenes")
      ->check(CLI::IsMember(synth::list_samplings()))
      ->capture_default_str();
  verb->add_option("--seed", o->request.seed, "Seed")->capture_default_str();
  verb->add_option("--outliers", o->request.outliers, "Share of stray points, 0 to 1")->capture_default_str();
  verb->add_option("--shift", o->shift, "Added to all coordinates: X Y Z")->expected(3);
  verb->add_flag("--rotate", o->request.rotate, "Rotate by a rotation drawn from the seed");
  verb->add_option("--set", o->options, "Option of the scene, NAME=NUMBER; may be given several times")->take_all();
  verb->add_option("--scale", o->scale, "LAS scale (length; chosen if not given)");
  verb->add_option("--threads", o->threads, "Threads; 0 for all")->capture_default_str();
  verb->add_flag("--overwrite", o->overwrite, "Replace existing outputs");
  add_display_options(*verb, o->display);
  verb->callback([o, &session] { session.run = [o, &session] { return run_synth(*o, session); }; });
}

}  // namespace arris::tools
