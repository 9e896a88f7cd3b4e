/// @file arris evaluate.

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>

#include "commands.h"
#include "common_options.h"
#include "core/columns.h"
#include "core/error.h"
#include "core/text.h"
#include "core/units.h"
#include "evaluate/contour_evaluation.h"
#include "evaluate/evaluation_text.h"
#include "evaluate/label_comparison.h"
#include "evaluate_segments.h"
#include "io/attribute_reader.h"
#include "io/point_source.h"

namespace arris::tools {
namespace {

struct EvaluateOptions {
  std::string prediction;
  std::string truth;
  std::string input;
  std::string edges = "all";
  std::string classes = "all";
  std::string spacing, noise;
  std::string local_spacing;
  double min_score = -std::numeric_limits<double>::infinity();
  bool forgive = false;
  bool json = false;
  bool csv = false;
  SegmentsOptions segments;
};

double world(const io::PointBatch& batch, const io::SourceInfo& info, int axis, std::size_t i) {
  if (!info.scaled_integers) return (axis == 0 ? batch.x : axis == 1 ? batch.y : batch.z)[i];
  const std::int32_t stored = (axis == 0 ? batch.ix : axis == 1 ? batch.iy : batch.iz)[i];
  return static_cast<double>(stored) * info.scale[axis] + info.offset[axis];
}

std::uint8_t parse_classes(const std::string& text) {
  if (text == "all") return 0xff;
  if (text == "boundary") return kBoundary | kWeakBoundary;
  if (text == "strong-boundary") return kBoundary;
  return kFold;
}

std::vector<evaluate::PredictedPoint> read_predictions(const std::string& path, bool& has_scores) {
  const std::unique_ptr<io::PointSource> source = io::open_point_source(path);
  io::AttributeReader attributes(path, {"EdgeClass", "EdgeScore"});
  has_scores = attributes.has(1);
  std::vector<evaluate::PredictedPoint> points;
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = true;
  std::vector<double> classes;
  std::vector<double> scores;
  while (source->read(batch, options)) {
    if (attributes.has(0)) attributes.read(batch, 0, classes);
    if (attributes.has(1)) attributes.read(batch, 1, scores);
    for (std::size_t i = 0; i < batch.count; ++i) {
      evaluate::PredictedPoint p;
      p.x = world(batch, source->info(), 0, i);
      p.y = world(batch, source->info(), 1, i);
      p.z = world(batch, source->info(), 2, i);
      if (attributes.has(0)) p.classes = static_cast<std::uint8_t>(classes[i]);
      if (attributes.has(1)) p.score = static_cast<float>(scores[i]);
      if (p.classes != 0) points.push_back(p);  // Points that --keep-all carried along are no detections.
    }
  }
  return points;
}

void add_input(const std::string& path, evaluate::InputCoverage& coverage, evaluate::LabelComparison& labels) {
  io::InputSet inputs(io::expand_inputs(std::vector<std::string>{path}));
  io::PointBatch batch;
  std::vector<evaluate::Vec3> points;
  while (inputs.read(batch, {})) {
    const io::SourceInfo& info = inputs.sources()[inputs.source_index()];
    points.clear();
    for (std::size_t i = 0; i < batch.count; ++i)
      points.push_back({world(batch, info, 0, i), world(batch, info, 1, i), world(batch, info, 2, i)});
    coverage.add(points);
    labels.add(points);
  }
}

int run_evaluate(const EvaluateOptions& o, Session& session) {
  if (!o.segments.truth.empty()) {
    const ResultFormat format = o.json ? ResultFormat::kJson : o.csv ? ResultFormat::kCsv : ResultFormat::kTable;
    return evaluate_segments(o.prediction, o.segments, o.spacing, format, session);
  }
  if (o.truth.empty()) {
    throw ConfigError("nothing to compare with: give --truth T.csv for contour points, or --labels CLOUD for segments");
  }
  const evaluate::Truth truth = evaluate::read_truth_csv(std::filesystem::path(o.truth));
  evaluate::EvaluationOptions options;
  options.kinds = evaluate::parse_kinds(o.edges);
  options.class_mask = parse_classes(o.classes);
  options.forgive_other_kinds = o.forgive;
  if (!o.spacing.empty()) options.spacing = parse_length(o.spacing);
  if (!o.noise.empty()) options.noise = parse_length(o.noise);
  if (o.local_spacing == "mean") options.spacing_of = evaluate::SpacingOf::kLocal;
  if (o.local_spacing == "max") options.spacing_of = evaluate::SpacingOf::kLocalMax;
  options.min_score = static_cast<float>(o.min_score);
  const std::vector<evaluate::PredictedPoint> points = read_predictions(o.prediction, options.scores);
  if (std::isfinite(o.min_score) && !options.scores) {
    throw ConfigError(printable(o.prediction) + " has no EdgeScore; leave --min-score out");
  }
  std::optional<evaluate::InputCoverage> coverage;
  std::optional<evaluate::LabelComparison> labels;
  if (!o.input.empty()) {
    coverage.emplace(truth, options);
    labels.emplace(points, truth, options);
    add_input(o.input, *coverage, *labels);
  }
  evaluate::ContourEvaluation result =
      evaluate::evaluate_contours(points, truth, options, coverage ? &*coverage : nullptr);
  if (labels) result.labels = labels->result();
  write_text("-",
             o.json  ? evaluate::to_json(result)
             : o.csv ? evaluate::to_csv(result)
                     : evaluate::to_table(result),
             false);
  return 0;
}

}  // namespace

void add_evaluate(CLI::App& app, Session& session) {
  auto o = std::make_shared<EvaluateOptions>();
  CLI::App* verb = app.add_subcommand("evaluate", "Judge contour points, supervoxels or segments against the truth");
  verb->add_option("prediction", o->prediction,
                   "Contour points (output of extract), supervoxels or segments, or any cloud")
      ->required();
  CLI::Option* truth = verb->add_option("--truth", o->truth, "Judge contour points: edges of the scene (CSV of synth)");
  const auto contours = [truth](CLI::Option* option) { return option->needs(truth); };
  contours(verb->add_option(
      "--input", o->input,
      "The scan itself: prints the recall that a perfect detector could reach on it, and how the labels of its "
      "points agree with the truth"));
  contours(
      verb->add_option("--edges", o->edges, "Truth that counts: all, folds, boundaries, or kinds joined by commas"))
      ->capture_default_str();
  contours(verb->add_option("--classes", o->classes, "Predictions that count"))
      ->check(CLI::IsMember({"all", "fold", "boundary", "strong-boundary"}))
      ->capture_default_str();
  verb->add_option("--spacing", o->spacing,
                   "Point spacing (length; default: the truth's, with --labels an estimate from the points)");
  contours(
      verb->add_flag("--local-spacing{mean}", o->local_spacing,
                     "Tolerances are multiples of each edge's own spacing in the truth; =max: of that in the coarser "
                     "direction"))
      ->check(CLI::IsMember({"mean", "max"}));
  contours(verb->add_option("--min-score", o->min_score, "Predictions with a lower EdgeScore do not count"));
  contours(verb->add_option("--noise", o->noise, "Noise (length; default: the truth's)"));
  contours(verb->add_flag("--forgive-other-kinds", o->forgive,
                          "Predictions near truth that does not count are left out instead of called false"));
  add_segments_options(*verb, o->segments)->excludes(truth);
  CLI::Option* json = verb->add_flag("--json", o->json, "As JSON");
  verb->add_flag("--csv", o->csv, "As CSV, a line per tolerance")->excludes(json);
  verb->callback([o, &session] { session.run = [o, &session] { return run_evaluate(*o, session); }; });
}

}  // namespace arris::tools
