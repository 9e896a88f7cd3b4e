#include "evaluate/truth_samples.h"

#include <cmath>

#include "core/error.h"

namespace arris::evaluate {

namespace {
constexpr double kMostSamples = 2147483648.0;
}

TruthSamples::TruthSamples(const std::vector<TruthEdge>& edges, double step) {
  double count = 0.0;
  for (const TruthEdge& edge : edges) {
    if (edge.length() > 0.0) count += std::max(1.0, std::ceil(edge.length() / step));
  }
  if (!(count < kMostSamples))
    throw ConfigError("the spacing is too small for the length of the truth edges; give a larger one");
  samples_.reserve(static_cast<std::size_t>(count));
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const double length = edges[e].length();
    if (!(length > 0.0)) continue;
    const std::size_t pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(length / step)));
    for (std::size_t i = 0; i < pieces; ++i) {
      const double fraction = (static_cast<double>(i) + 0.5) / static_cast<double>(pieces);
      samples_.push_back(
          {edges[e].point_at(fraction), length / static_cast<double>(pieces), static_cast<std::uint32_t>(e)});
    }
    total_length_ += length;
  }
  tree_ = BoxTree(samples_.size(), [this](std::size_t i) { return Box3{samples_[i].position, samples_[i].position}; });
}

}  // namespace arris::evaluate
