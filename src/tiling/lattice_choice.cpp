#include "tiling/lattice_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace arris::tiling {
namespace {

constexpr double kMultipleTolerance = 1e-12;
constexpr double kSmallestStep = 1e-9;
constexpr double kOriginSteps = 65536.0;            // Origins sit on multiples of 2^16 steps.
constexpr double kLongestAxisSteps = 2147483648.0;  // +-2^30 steps around the origin.
constexpr double kHistogramCellSteps = 67108864.0;  // 2^26.
constexpr double kInt32Min = -2147483648.0;
constexpr double kInt32Max = 2147483647.0;

bool share_scale(const std::vector<io::SourceInfo>& sources) {
  return !sources.empty() && std::ranges::all_of(sources, [&](const io::SourceInfo& source) {
    return source.scaled_integers && source.scale == sources.front().scale &&
           std::ranges::all_of(source.offset, [](double offset) { return std::isfinite(offset); });
  });
}

}  // namespace

std::int64_t whole_multiple(double coarse, double fine) {
  if (!(fine > 0.0) || !(coarse > 0.0)) return 0;
  const double ratio = coarse / fine;
  if (!(ratio < kLongestAxisSteps)) return 0;
  const double whole = std::round(ratio);
  return whole >= 1.0 && std::abs(ratio - whole) <= kMultipleTolerance * whole ? static_cast<std::int64_t>(whole) : 0;
}

LatticeChoice::LatticeChoice(const std::vector<io::SourceInfo>& sources, double requested_step) : sources_(sources) {
  if (!std::isfinite(requested_step) || requested_step < 0.0 ||
      (requested_step > 0.0 && requested_step < kSmallestStep)) {
    throw ConfigError(fmt::format("lattice step {} is not valid: give 0 (automatic) or a length of at least {}",
                                  requested_step, kSmallestStep));
  }
  base_.step = requested_step > 0.0 ? requested_step : kDefaultLatticeStep;
  if (requested_step == 0.0 && share_scale(sources)) {
    const auto& scale = sources.front().scale;
    const double finest = *std::ranges::min_element(scale);
    exact_ = std::ranges::all_of(scale, [&](double s) { return whole_multiple(s, finest) > 0; });
    if (exact_) {
      base_.step = finest;
      base_.origin = std::ranges::min_element(sources, {}, &io::SourceInfo::offset)->offset;
      // Stored integers that are lattice indices as they are always fit.
      needs_points_ = !std::ranges::all_of(scale, [&](double s) { return whole_multiple(s, finest) == 1; }) ||
                      !std::ranges::all_of(sources, [&](const auto& source) { return source.offset == base_.origin; });
    }
  }
  ranges_.assign(3, AxisRange(base_.step * kHistogramCellSteps));
}

void LatticeChoice::add(const io::PointBatch& batch, std::size_t source_index) {
  const io::SourceInfo& source = sources_.at(source_index);
  const auto& p = batch;
  if (source.scaled_integers) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      ranges_[0].add(source.offset[0] + source.scale[0] * p.ix[i]);
      ranges_[1].add(source.offset[1] + source.scale[1] * p.iy[i]);
      ranges_[2].add(source.offset[2] + source.scale[2] * p.iz[i]);
    }
    return;
  }
  for (std::size_t i = 0; i < batch.count; ++i) {
    if (!std::isfinite(p.x[i]) || !std::isfinite(p.y[i]) || !std::isfinite(p.z[i])) continue;
    ranges_[0].add(p.x[i]);
    ranges_[1].add(p.y[i]);
    ranges_[2].add(p.z[i]);
  }
}

std::optional<Lattice> LatticeChoice::with_step(double step) const {
  Lattice lattice{step, base_.origin};
  const bool keep_origin = exact_ && step == base_.step;
  for (int axis = 0; axis < 3; ++axis) {
    const auto window = ranges_[static_cast<std::size_t>(axis)].window(kLongestAxisSteps * step);
    if (!window) return std::nullopt;
    const double middle = window->min + (window->max - window->min) / 2.0;
    double& origin = lattice.origin[static_cast<std::size_t>(axis)];
    if (keep_origin) {
      const bool fits = (window->min - origin) / step >= kInt32Min && (window->max - origin) / step <= kInt32Max;
      if (!fits) origin += std::floor((middle - origin) / (step * kOriginSteps)) * (step * kOriginSteps);
    } else {
      origin = std::floor(middle / (step * kOriginSteps)) * (step * kOriginSteps);
    }
  }
  return lattice;
}

Lattice LatticeChoice::lattice() const {
  if (!needs_points_) return base_;
  // Coordinates are below 1e12, so this ends.
  for (double step = base_.step;; step *= 10.0) {
    if (const auto lattice = with_step(step)) return *lattice;
  }
}

}  // namespace arris::tiling
