#include "evaluate/truth_samples.h"

#include <cmath>

#include "core/error.h"
#include "evaluate/unit_groups.h"

namespace arris::evaluate {

namespace {
constexpr double kMostSamples = 2147483648.0;
}

TruthSamples::TruthSamples(const std::vector<TruthEdge>& edges, double step, std::vector<double> units)
    : units_(std::move(units)) {
  const auto pieces_of = [&](std::size_t e) {
    return std::max(1.0, std::ceil(edges[e].length() / (step * units_[e])));
  };
  double count = 0.0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].length() > 0.0) count += pieces_of(e);
  }
  if (!(count < kMostSamples))
    throw ConfigError("the spacing is too small for the length of the truth edges; give a larger one");
  samples_.reserve(static_cast<std::size_t>(count));
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const double length = edges[e].length();
    if (!(length > 0.0)) continue;
    const std::size_t pieces = static_cast<std::size_t>(pieces_of(e));
    for (std::size_t i = 0; i < pieces; ++i) {
      const double fraction = (static_cast<double>(i) + 0.5) / static_cast<double>(pieces);
      samples_.push_back(
          {edges[e].point_at(fraction), length / static_cast<double>(pieces), static_cast<std::uint32_t>(e)});
    }
    total_length_ += length;
  }
  std::vector<double> sample_units;
  for (const Sample& sample : samples_) sample_units.push_back(unit_of(sample));
  for (UnitGroup& of_unit : group_by_unit(sample_units)) {
    Group& group = groups_.emplace_back();
    group.longest_unit = of_unit.longest;
    group.samples = std::move(of_unit.items);
    group.tree = BoxTree(group.samples.size(), [&](std::size_t i) {
      const Vec3& position = samples_[group.samples[i]].position;
      return Box3{position, position};
    });
  }
}

}  // namespace arris::evaluate
