#include "merge/segment_sides.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace arris::merge {
namespace {

/// Of the distances on one side and the other, the difference must be at least this share of the sum.
constexpr double kOneSided = 0.5;
/// Distances are cut here: a few stray points must not decide.
constexpr double kMostSpacings = 4.0;

}  // namespace

void SegmentSides::add(std::uint32_t segment, std::uint32_t other, const LatticePoint& p, std::int64_t neighbours) {
  const SegmentPlane& plane = planes_[other - 1];
  const double most = kMostSpacings * plane.spacing;
  const auto steps = static_cast<std::int64_t>(std::llround(std::clamp(signed_distance(plane, p), -most, most)));
  Sum& sum = sums_[key(segment, other)];
  sum.signed_steps += neighbours * steps;
  sum.steps += neighbours * std::abs(steps);
}

void SegmentSides::add(const SegmentSides& more) {
  for (const auto& [pair, sum] : more.sums_) {
    sums_[pair].signed_steps += sum.signed_steps;
    sums_[pair].steps += sum.steps;
  }
}

int SegmentSides::side(std::uint32_t segment, std::uint32_t other) const {
  const auto found = sums_.find(key(segment, other));
  if (found == sums_.end()) return 0;
  const Sum& sum = found->second;
  if (static_cast<double>(std::abs(sum.signed_steps)) < kOneSided * static_cast<double>(sum.steps)) return 0;
  return sum.signed_steps > 0 ? 1 : sum.signed_steps < 0 ? -1 : 0;
}

}  // namespace arris::merge
