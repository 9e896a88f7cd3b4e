#pragma once
/// @file The two planes that explain a ball best: two arms that part at a line, or two layers.

#include "features/neighbourhood/plane_fit.h"

namespace arris {

/// Lengths in spacings, relative to the ball's centre.
struct PlanePair {
  enum class Kind : std::uint8_t {
    kNone,    ///< No two planes explain the ball.
    kArms,    ///< Two half-planes that meet in a line which crosses the ball.
    kLayers,  ///< Two nearly parallel sheets.
  } kind = Kind::kNone;
  FittedPlane a, b;
  Split split;
  double rms = 0.0;  ///< Of the distances to the plane of a point's side, each cut at kMostDistance.
};

/// Alternates between fitting a plane to each side of a split and splitting at the bisector of the planes, from five
/// starting splits (across the ball's principal directions, the two diagonals in its plane, and along its plane), a
/// fixed number of times; the start that ends with the smallest rms wins. Splitting at the bisector, not by the nearer
/// plane, keeps the arms one-sided: an L, not an X. Law: bits depend on the set of points only. O(points).
/// @param all  the plane through all points of the ball.
PlanePair fit_plane_pair(const BallPoints& points, double radius, const FittedPlane& all);

}  // namespace arris
