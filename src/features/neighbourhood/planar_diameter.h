#pragma once
/// @file The two farthest points of a planar set.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace arris {

struct PlanarPoint {
  double x = 0, y = 0;
  double d2 = 0;         ///< Canonical order is (d2, id): squared distance to the centre, ...
  std::uint64_t id = 0;  ///< ... then the global id.
};

struct Diameter {
  PlanarPoint a, b;    ///< a comes before b in canonical order.
  double length2 = 0;  ///< 0 if all points coincide (or there are fewer than two).
};

/// Convex hull (monotone chain) and rotating calipers. No pair is longer by more than rounding (1e-12 of its length).
/// Ties of the computed length go to the pair that is first in canonical order. O(n log n); O(h^2) for h vertices of
/// which most are in one place or on one line but for rounding. `points` is reordered and cut down to its hull; `hull`
/// is reusable memory. Law: bits depend on the set only, not on its order.
Diameter planar_diameter(std::vector<PlanarPoint>& points, std::vector<PlanarPoint>& hull);

}  // namespace arris
