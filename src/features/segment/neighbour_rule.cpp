#include "features/segment/neighbour_rule.h"

#include <algorithm>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

constexpr double kAcross2 = 9.0;

/// Of nu^2: a level is taken from there on.
double least_noise2_of(std::size_t level) {
  const double share = kNoiseOfFewest / static_cast<double>(kFewestNeighbours);
  return share * share * static_cast<double>(kNeighbourLevels[level - 1] * kNeighbourLevels[level]);
}

/// (l0 l1 + l0 l2 + l1 l2) / (l0 + l1 + l2) of the query and its first m neighbours: l1, if they lie along a line, half
/// of it if they fill a disc.
double variance_across(const PackedNeighbours& found, std::size_t m) {
  double x = 0.0, y = 0.0, z = 0.0, xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  for (std::size_t i = 0; i < m; ++i) {
    const auto [dx, dy, dz] = found.offset(i);
    x += dx, y += dy, z += dz;
    xx += dx * dx, xy += dx * dy, xz += dx * dz;
    yy += dy * dy, yz += dy * dz, zz += dz * dz;
  }
  const double n = static_cast<double>(m + 1);
  xx -= x * x / n, xy -= x * y / n, xz -= x * z / n;
  yy -= y * y / n, yz -= y * z / n, zz -= z * z / n;
  const double trace = xx + yy + zz;
  return trace > 0.0 ? (xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz) / (trace * n) : 0.0;
}

}  // namespace

std::size_t neighbours_for(double noise_over_spacing) {
  const double nu2 = noise_over_spacing * noise_over_spacing;
  std::size_t level = 0;
  while (level + 1 < kNeighbourLevels.size() && nu2 > least_noise2_of(level + 1)) ++level;
  return kNeighbourLevels[level];
}

NeighbourRule::NeighbourRule(double noise_steps, std::size_t most)
    : least_(kFewestNeighbours), most_(most), noise2_(noise_steps * noise_steps) {}

std::size_t NeighbourRule::wanted_by_spacing(const PackedNeighbours& found) const {
  const double m = static_cast<double>(least_);
  const double across2 = kAcross2 * 4.0 * kPi * variance_across(found, least_) / (m + 1.0);
  const double spacing2 = std::min(kPi * found.offset(least_ - 1).squared() / m, across2);
  std::size_t level = 0;
  while (level + 1 < kNeighbourLevels.size() && noise2_ > least_noise2_of(level + 1) * spacing2) ++level;
  return std::min(kNeighbourLevels[level], most_);
}

}  // namespace arris
