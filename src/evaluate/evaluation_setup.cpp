#include "evaluate/evaluation_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace arris::evaluate {

EvaluationSetup prepare(const Truth& truth, const EvaluationOptions& options) {
  EvaluationSetup setup;
  setup.spacing = options.spacing != 0.0 ? options.spacing : truth.number("spacing", 0.0);
  if (!(setup.spacing > 0.0) || !std::isfinite(setup.spacing)) {
    throw ConfigError(
        "the point spacing is not known: the truth file has no positive \"# spacing=\"; give the spacing");
  }
  setup.noise = options.noise >= 0.0 ? options.noise : truth.number("noise", 0.0);
  if (!std::isfinite(setup.noise)) throw ConfigError("the noise must be finite");
  for (const double factor : options.tolerance_factors) {
    if (!(factor > 0.0) || !std::isfinite(factor))
      throw ConfigError(fmt::format("tolerance factor {} must be above 0", factor));
    setup.tolerances.push_back(factor * setup.spacing);
  }
  setup.tolerances.push_back(std::max(setup.spacing, 3.0 * setup.noise));
  std::sort(setup.tolerances.begin(), setup.tolerances.end());
  const auto same = [](double a, double b) { return b - a <= kToleranceSlack * b; };
  setup.tolerances.erase(std::unique(setup.tolerances.begin(), setup.tolerances.end(), same), setup.tolerances.end());
  for (const TruthEdge& edge : truth.edges) {
    ((options.kinds & mask(edge.kind)) != 0 ? setup.counted : setup.others).push_back(edge);
  }
  return setup;
}

}  // namespace arris::evaluate
