#pragma once
/// @file Points of the plane that are on no convex hull, found without sorting.

#include <cstdint>
#include <utility>
#include <vector>

namespace arris {

using Planar = std::pair<double, double>;

/// Reusable memory.
struct InnerScratch {
  std::vector<double> x, y;
  std::vector<std::int64_t> marks;
};

/// Takes out most points that are well inside of the convex hull: those inside of the octagon whose corners are the
/// outermost points in eight directions, of equally far ones the least (x, y). What is left is a function of the set of
/// points, in the order given. Few points stay as they are. O(n), without sorting.
void drop_inner_points(std::vector<Planar>& points, InnerScratch& scratch);

}  // namespace arris
