#pragma once
/// @file The points of a layer seen along its normal from one of them.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/neighbourhood/plane_fit.h"

namespace arris {

/// Nearer projections have no azimuth, spacings.
constexpr double kLeastOffset = 0.25;
/// Azimuths of points this near tell of holes that the whole disc reaches across.
constexpr double kNearDisc = 3.0;

/// Coordinates in the plane's frame. Arrays are padded like those of the ball.
struct LayerView {
  std::vector<double> u, v;
  std::vector<double> reach2;  ///< u² + v²; negative: not of the layer.
  std::size_t points = 0;      ///< Of the ball.
  double count = 0.0;          ///< Of the layer.
  double inner = 0.0;          ///< Of these, in the inner half of the gate.
  double beyond = 0.0;         ///< Between one and two gates from the plane.
  double azimuths = 0.0;       ///< Of the layer, farther than kLeastOffset.
  /// True unless the azimuths, of all points and of those within kNearDisc, are too dense for a gap of 105 degrees.
  bool may_have_gap = false;
};

/// Looks at the points within `radius`; those within `gate` of the plane are its layer. Law: bits depend on the set of
/// points only. O(points).
void look_at_layer(const BallPoints& points, double radius, const FittedPlane& plane, double gate, LayerView& view);

}  // namespace arris
