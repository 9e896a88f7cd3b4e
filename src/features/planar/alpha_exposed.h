#pragma once
/// @file Border points of planar point sets: the vertices of the alpha shape (Edelsbrunner, Kirkpatrick and Seidel
/// 1983), decided point by point without a triangulation.

#include <cstddef>
#include <utility>
#include <vector>

namespace arris {

/// Free directions that are narrower than this, degrees, are none: where the ends of blocked directions touch (a disc
/// with three or more points on its circle) the disc does not count as empty, whatever the rounding.
constexpr double kTouch_deg = 1e-7;

/// Neighbours of one point: projections on the plane minus the point's own, in units of 2 alpha. Any order.
struct PlaneNeighbours {
  std::vector<double> a, b;
  std::size_t count = 0;  ///< The columns may be longer.
};

/// A point is exposed if an open disc of radius alpha whose circle passes through it holds no neighbour. A neighbour at
/// the distance d < 2 alpha keeps the centres of discs from directions closer than acos(d / (2 alpha)) to its own; the
/// point is exposed if all neighbours together leave a direction free. Neighbours at 2 alpha or farther, and those
/// whose projections coincide with the point's (within 1e-9 of 2 alpha), block nothing. A point whose neighbours lie on
/// one line is exposed.
class AlphaExposure {
 public:
  /// Width of the widest free range of directions, degrees: 0 if the point is not exposed, 360 if nothing is blocked.
  /// A straight border with spacing s shows 2 asin(s / (2 alpha)). Law: bits depend on the set of neighbours only.
  /// O(n) for most points inside, else O(n log n).
  double operator()(const PlaneNeighbours& neighbours);
  /// True only if the point is not exposed, whatever further neighbours there are; false says nothing.
  bool surely_blocked(const PlaneNeighbours& neighbours) const;
  /// The width without the early rejection: for tests, which require equality.
  double without_rejection(const PlaneNeighbours& neighbours);

 private:
  std::vector<std::pair<double, double>> blocked_;  ///< Start and end of blocked directions, start in [-pi, pi].
};

}  // namespace arris
