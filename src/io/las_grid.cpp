#include "io/las_grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace arris::io {
namespace {

constexpr int kUsualExponent = -4;
constexpr int kFinestExponent = -9;
constexpr int kCoarsestExponent = 6;
/// Below this longest side the usual scale leaves fewer than 10^5 steps.
constexpr double kSmallExtent = 10.0;
/// A margin below 2^31 for rounding.
constexpr double kMostSteps = 2147483000.0;

/// 10^exponent, correctly rounded, which std::pow does not promise.
double power_of_ten(int exponent) {
  double positive = 1.0;
  for (int i = 0; i < std::abs(exponent); ++i) positive *= 10.0;
  return exponent < 0 ? 1.0 / positive : positive;
}

}  // namespace

LasGrid choose_las_grid(const WorldExtent& extent) {
  LasGrid grid;
  double longest = 0.0;
  double reach = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double min = extent.min[axis];
    const double max = extent.max[axis];
    if (!(min <= max)) return grid;  // No points.
    longest = std::max(longest, max - min);
    // Offset 0 keeps numbers readable wherever a million units around the origin hold everything.
    const bool near_origin = std::max(std::abs(min), std::abs(max)) < 1000.0;
    grid.offset[axis] = near_origin ? 0.0 : std::round(min / 2.0 + max / 2.0);
    reach = std::max({reach, std::abs(max - grid.offset[axis]), std::abs(min - grid.offset[axis])});
  }
  int exponent = kUsualExponent;
  if (longest > 0.0 && longest < kSmallExtent) {
    while (exponent > kFinestExponent && longest / power_of_ten(exponent) < 1e5) --exponent;
  }
  while (exponent <= kCoarsestExponent && reach / power_of_ten(exponent) > kMostSteps) ++exponent;
  if (exponent > kCoarsestExponent || !std::isfinite(reach)) {
    throw ConfigError(fmt::format(
        "coordinates up to {} from their middle do not fit LAS integers; remove outliers or write PLY", reach));
  }
  grid.scale.fill(power_of_ten(exponent));
  return grid;
}

LasGrid merge_las_grids(const std::vector<SourceInfo>& inputs, const WorldExtent& extent) {
  LasGrid grid;
  bool first = true;
  for (const SourceInfo& input : inputs) {
    if (!input.scaled_integers) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double scale = std::abs(input.scale[axis]);
      if (first) grid.offset[axis] = input.offset[axis];
      if (first || scale < std::abs(grid.scale[axis])) grid.scale[axis] = first ? input.scale[axis] : scale;
    }
    first = false;
  }
  if (first) return choose_las_grid(extent);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double min = extent.min[axis];
    const double max = extent.max[axis];
    if (!(min <= max) || (grid.stored(axis, min) && grid.stored(axis, max))) continue;
    grid.offset[axis] = std::round(min / 2.0 + max / 2.0);
    if (!grid.stored(axis, min) || !grid.stored(axis, max)) return choose_las_grid(extent);
  }
  const bool floats =
      std::any_of(inputs.begin(), inputs.end(), [](const auto& input) { return !input.scaled_integers; });
  if (!floats) return grid;
  // Steps fit for the integers of one input may be too coarse for the floating point of another.
  const LasGrid free = choose_las_grid(extent);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (free.scale[axis] >= std::abs(grid.scale[axis])) continue;
    grid.scale[axis] = free.scale[axis];
    grid.offset[axis] = free.offset[axis];
  }
  return grid;
}

}  // namespace arris::io
