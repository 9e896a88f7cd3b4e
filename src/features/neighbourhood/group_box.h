#pragma once
/// @file What the searches for groups of queries share.

#include <algorithm>
#include <cstdint>
#include <span>

#include "features/neighbourhood/point_tree.h"

namespace arris {

/// The narrowest type to compute in. All give the same results; wider ones are taken where a narrower is not exact.
enum class Arithmetic : std::uint8_t { kFloat, kDouble, kInt64 };

namespace detail {

/// Box around the slots of queries.
template <class Query, class SlotOf>
ClosedBox box_of(const PointTree& tree, std::span<const Query> queries, SlotOf&& slot_of) {
  const LatticePoint first = tree.position(slot_of(queries[0]));
  ClosedBox box{{first.x, first.y, first.z}, {first.x, first.y, first.z}};
  for (const Query& query : queries) {
    const LatticePoint p = tree.position(slot_of(query));
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], p[axis]);
      box.max[axis] = std::max(box.max[axis], p[axis]);
    }
  }
  return box;
}

}  // namespace detail

}  // namespace arris
