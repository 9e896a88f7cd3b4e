#pragma once
/// @file The convex hull of a few points in the plane.

#include <cstdint>
#include <vector>

#include "features/arris/inner_points.h"

namespace arris {

/// Reusable memory.
struct HullScratch {
  std::vector<float> keys;
  std::vector<std::int32_t> ranks;
  std::vector<Planar> sorted, hull;
  InnerScratch inner;
};

/// Sorts points by (x, y): a function of the set of points only.
void sort_planar(std::vector<Planar>& points, HullScratch& scratch);

/// Replaces points by their convex hull, counter-clockwise (monotone chain of those that drop_inner_points() leaves);
/// equal points may be there. A function of the set of points only. O(n log n), and for the few hundred points of a
/// ball quicker than that sounds.
void keep_hull(std::vector<Planar>& points, HullScratch& scratch);

}  // namespace arris
