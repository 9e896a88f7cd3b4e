#pragma once
/// @file Outline edges of a segment linked to rings, and rings put together to polygons.
///
/// Laws: (1) the result depends on the set of edges only; (2) rings are simple: no vertex comes twice in one (rings may
/// touch each other in vertices), and no edges cross; (3) every edge is in one ring, but for edges whose other ends are
/// missing; (4) outer rings go counterclockwise and holes clockwise, seen against the plane's normal; (5) each ring
/// begins with its smallest id, holes and polygons are in ascending order of their first vertices.

#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "features/segment/segment_plane.h"
#include "features/segment_contours/outline_edge.h"

namespace arris::merge {

struct OutlineVertex {
  std::uint64_t id = 0;
  LatticePoint position;

  friend auto operator<=>(const OutlineVertex&, const OutlineVertex&) = default;
};

/// At least three vertices; the last is joined to the first, which is not repeated.
using OutlineRing = std::vector<OutlineVertex>;

struct OutlinePolygon {
  OutlineRing outer;
  std::vector<OutlineRing> holes;
  double area = 0.0;  ///< Without the holes, in the plane; square data units.
};

struct SegmentOutline {
  std::uint32_t segment = 0;
  std::vector<OutlinePolygon> polygons;
  double area = 0.0;  ///< Of all polygons.
};

/// @param edges  of one segment, any order; as analyse_segment_contours gives them for the whole scan.
/// Where an edge has no continuation (never, if the edges are complete) its chain is left out.
/// O(n log n), and for holes O(sqrt(n)) per hole and edge nearby; about 200 bytes per edge while it works.
SegmentOutline link_outline(std::span<const OutlineEdge> edges, const SegmentPlane& plane, const Lattice& lattice);

/// The same for all segments that have outlines, in ascending order; edges of any segments in any order.
std::vector<SegmentOutline> link_outlines(std::vector<OutlineEdge> edges, std::span<const SegmentPlane> planes,
                                          const Lattice& lattice);

}  // namespace arris::merge
