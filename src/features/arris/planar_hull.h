#pragma once
/// @file The convex hull of a few points in the plane.

#include <cstdint>
#include <utility>
#include <vector>

namespace arris {

using Planar = std::pair<double, double>;

/// Reusable memory.
struct HullScratch {
  std::vector<float> keys;
  std::vector<std::int32_t> ranks;
  std::vector<Planar> sorted, hull;
};

/// Sorts points by (x, y): a function of the set of points only.
void sort_planar(std::vector<Planar>& points, HullScratch& scratch);

/// Replaces points by their convex hull, counter-clockwise (monotone chain); equal points may be there. O(n log n), and
/// for the few hundred points of a ball quicker than that sounds.
void keep_hull(std::vector<Planar>& points, HullScratch& scratch);

}  // namespace arris
