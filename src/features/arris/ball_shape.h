#pragma once
/// @file How the points of balls spread: the first thing that is asked of every point.

#include <span>

#include "features/neighbourhood/ball_moments.h"

namespace arris {

struct BallShape {
  double count = 0.0;
  double rms = 0.0;         ///< About the plane, spacings.
  double middle_rms = 0.0;  ///< Spread along the shorter direction of the plane.
  double off_centre = 0.0;  ///< Distance of the mean from the centre, radii.
};

/// The moments of a ball, and the lengths (steps) that its shape is measured in.
struct BallMeasure {
  BallMoments moments;
  double radius = 1.0;
  double spacing = 1.0;
};

/// Shapes of many balls, as many at once as the processor's vectors hold; same bits as one by one. Needs at least one
/// point per ball and as many `shapes` as balls.
void measure_shapes(std::span<const BallMeasure> balls, std::span<BallShape> shapes);

}  // namespace arris
