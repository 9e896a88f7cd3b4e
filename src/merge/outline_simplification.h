#pragma once
/// @file Outlines with fewer vertices.

#include "merge/outline_rings.h"

namespace arris::merge {

/// Douglas and Peucker (1973) for every ring, in the plane: vertices that are left out are no farther than `tolerance`
/// (data units, > 0) from the edge that replaces theirs. Each ring is parted at its first vertex and the one farthest
/// from it, which stay. A polygon that would not be valid (outline_validity.h) keeps all of its vertices. Areas are not
/// touched: they are those of the outline as found. Deterministic. O(n log n) for most polygons, O(n²) at worst.
void simplify_outline(SegmentOutline& outline, const SegmentPlane& plane, const Lattice& lattice, double tolerance);

}  // namespace arris::merge
