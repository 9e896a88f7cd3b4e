#pragma once
/// @file Directed edges linked to simple loops.

#include <cstdint>
#include <span>
#include <vector>

#include "merge/outline_plane.h"

namespace arris::merge {

struct IndexedEdge {
  std::uint32_t from = 0, to = 0;

  friend auto operator<=>(const IndexedEdge&, const IndexedEdge&) = default;
};

/// Vertices, each at most once; starting with the smallest.
using Loop = std::vector<std::uint32_t>;

/// Twice the area of a loop of at least one vertex, > 0 counterclockwise.
Area twice_area(const Loop& loop, std::span<const PlanePosition> at);

/// Follows edges with the interior to the left: where several leave a vertex, along the same part of the interior that
/// the edge that came in has. Where a walk comes to a vertex again, what lies between is a loop of its own.
/// @param edges  ascending and distinct; vertices are numbers below at.size().
/// @return loops of at least three vertices, in ascending order. Walks that do not close are left out.
/// O(n log n) if few edges share a vertex.
std::vector<Loop> link_loops(std::span<const IndexedEdge> edges, std::span<const PlanePosition> at);

}  // namespace arris::merge
