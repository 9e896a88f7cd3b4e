#pragma once
/// @file The line in which two arms meet, refined with arms that may bend along it.

#include "features/arris/plane_pair.h"

namespace arris {

/// Lengths in spacings, relative to the ball's centre.
struct FoldLine {
  Vector3 foot{0, 0, 0};       ///< The point of the line in the cross-section through the centre.
  Vector3 direction{1, 0, 0};  ///< Along the line, unit.
  Vector3 opening{0, 0, 1};    ///< Unit; halves the angle between the arms and points into it.
  double distance = 0.0;       ///< |foot|.
  double angle_deg = 180.0;    ///< Between the arms, (0, 180].
  double sine2_half = 1.0;     ///< Squared sine of half the angle.
  double rms = 0.0;            ///< Of the arms' points about their surfaces.
  double count_a = 0.0, count_b = 0.0;
  double position_error = 0.0;  ///< Standard deviation of the line's position that rms and counts stand for.
  /// Members next to the centre's place on the line, on either arm: a fold is no extrapolation.
  int support_a = 0, support_b = 0;
};

/// Fits offset = c + b u + a t + k t² to the points of each arm by least squares, t along the line and u away from it;
/// k, which follows curved folds and rims, only where it is three standard errors from 0. Points are assigned to the
/// arm that lies deeper, and left out beyond the gate, in a fixed number of rounds. Law: bits depend on the set of
/// points only: t and u are rounded to 1/32 spacing, offsets to 1/1024, so that all sums are exact.
/// @param pair  of kind kArms.
/// @return false if an arm has too few points to be fitted, or the arms do not meet.
bool refine_fold(const BallPoints& points, const PlanePair& pair, FoldLine& line);

}  // namespace arris
