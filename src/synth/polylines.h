#pragma once
/// @file Loose segments joined to polylines with few vertices. Private to synth.

#include <cstdint>
#include <vector>

#include "evaluate/vec3.h"

namespace arris::synth {

/// Ends with equal keys are the same place.
struct KeyedSegment {
  std::uint64_t key_a = 0, key_b = 0;
  evaluate::Vec3 a, b;
};

/// Chains of segments that share keys; a key with one or more than two segments ends its chains, a ring repeats its
/// first vertex as its last. The result depends on the order of the segments only. O(n log n).
std::vector<std::vector<evaluate::Vec3>> join_segments(const std::vector<KeyedSegment>& segments);

/// Leaves out vertices so that every one left out is within `tolerance` of the result (Douglas and Peucker 1973). The
/// ends stay. @param tolerance  > 0.
std::vector<evaluate::Vec3> simplify(const std::vector<evaluate::Vec3>& line, double tolerance);

}  // namespace arris::synth
