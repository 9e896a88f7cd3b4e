#include "evaluate/evaluation_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace arris::evaluate {

Judgement judge(const PredictedPoint& p, const EvaluationOptions& options) {
  if ((p.classes & options.class_mask) == 0) return Judgement::kMasked;
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return Judgement::kNonFinite;
  const bool threshold = options.scores && options.min_score > -std::numeric_limits<float>::infinity();
  return threshold && !(p.score >= options.min_score) ? Judgement::kBelowMinScore : Judgement::kCounts;
}

EvaluationSetup prepare(const Truth& truth, const EvaluationOptions& options) {
  EvaluationSetup setup;
  setup.spacing = options.spacing != 0.0 ? options.spacing : truth.number("spacing", 0.0);
  if (!(setup.spacing > 0.0) || !std::isfinite(setup.spacing)) {
    throw ConfigError(
        "the point spacing is not known: the truth file has no positive \"# spacing=\"; give the spacing");
  }
  setup.noise = options.noise >= 0.0 ? options.noise : truth.number("noise", 0.0);
  if (!std::isfinite(setup.noise)) throw ConfigError("the noise must be finite");
  setup.local = options.spacing_of != SpacingOf::kWhole;
  const auto local_spacing = [&](const TruthEdge& edge) {
    return options.spacing_of == SpacingOf::kLocalMax ? edge.spacing_max : edge.spacing;
  };
  if (setup.local && std::none_of(truth.edges.begin(), truth.edges.end(),
                                  [&](const TruthEdge& edge) { return local_spacing(edge) > 0.0; })) {
    throw ConfigError(
        "the truth has no local spacing (columns spacing and spacing_max, as synth writes them for scanned scenes); "
        "evaluate without local spacing");
  }
  for (const double factor : options.tolerance_factors) {
    if (!(factor > 0.0) || !std::isfinite(factor))
      throw ConfigError(fmt::format("tolerance factor {} must be above 0", factor));
    setup.tolerances.push_back(setup.local ? factor : factor * setup.spacing);
  }
  if (!setup.local) setup.tolerances.push_back(std::max(setup.spacing, 3.0 * setup.noise));
  std::sort(setup.tolerances.begin(), setup.tolerances.end());
  const auto same = [](double a, double b) { return b - a <= kToleranceSlack * b; };
  setup.tolerances.erase(std::unique(setup.tolerances.begin(), setup.tolerances.end(), same), setup.tolerances.end());
  for (const TruthEdge& edge : truth.edges) {
    const bool counts = (options.kinds & mask(edge.kind)) != 0;
    const double local = local_spacing(edge) > 0.0 ? local_spacing(edge) : setup.spacing;
    (counts ? setup.counted : setup.others).push_back(edge);
    (counts ? setup.units : setup.other_units).push_back(setup.local ? local : 1.0);
  }
  return setup;
}

}  // namespace arris::evaluate
