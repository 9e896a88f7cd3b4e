#pragma once
/// @file Which points of a tree become candidates.

#include <cstddef>
#include <cstdint>

#include "features/neighbourhood/candidate_set.h"

namespace arris {

/// The query box relative to the origin, and how far to look. A step more than asked for: rounding cannot lose a point.
template <class T>
struct Window {
  T low[3], high[3];
  T reach2;
  std::int64_t origin[3];
};

/// Appends the points [begin, end) of the tree that are near enough to the `n` candidates that are there; returns the
/// new count. Writes up to end - begin, rounded up to simd::kPadding, entries past `n`.
template <class T>
std::size_t append_near(const PointTree& tree, std::size_t begin, std::size_t end, const Window<T>& window,
                        CandidateSet<T>& out, std::size_t n);

}  // namespace arris
