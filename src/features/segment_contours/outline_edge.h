#pragma once
/// @file A directed edge of the outline of a segment.

#include <compare>
#include <cstdint>

#include "core/lattice.h"

namespace arris {

/// An edge of the border of the segment's alpha shape (planar/alpha_edges.h) in its plane: the interior is to the left,
/// seen against the plane's normal. Ids are those of entries of TilePoints (the smallest of duplicates); of several
/// points with the same place in the plane the one with the smallest id stands for all.
struct OutlineEdge {
  std::uint32_t segment = 0;
  std::uint64_t from = 0, to = 0;
  LatticePoint from_position, to_position;

  friend auto operator<=>(const OutlineEdge&, const OutlineEdge&) = default;
};

}  // namespace arris
