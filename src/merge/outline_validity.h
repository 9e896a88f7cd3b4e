#pragma once
/// @file Whether a polygon is simple, as the Simple Features of OGC want it.

#include "merge/outline_plane.h"
#include "merge/outline_rings.h"

namespace arris::merge {

/// True if no two sides of the polygon have a point in common but vertices of the same id, the outer ring goes
/// counterclockwise and the holes clockwise, and each hole lies in the outer ring and in no other hole.
/// O(n log n) for rings whose sides are short, exact.
bool is_valid(const OutlinePolygon& polygon, const OutlinePlane& plane);

}  // namespace arris::merge
