#pragma once
/// @file Whether a seam between supervoxels, or a border that a seam may explain, is a contour.

#include "features/point_analysis.h"

namespace arris {

/// What supervoxels say of a point.
struct SeamQuestion {
  bool fold = false;    ///< A fold may pass: supervoxels that are not coplanar meet near the point.
  bool border = false;  ///< The surface ends at the point: it is alpha-exposed.
  double least_turn_deg = 0.0;
  /// Of the ball's points about one plane, spacings.
  double rms = 0.0;
};

/// Asks the points themselves, whatever their labels: two planes that explain the ball of `radius` spacings around the
/// point better than one, and whose line passes the point, are a fold; otherwise the layer that holds the point is a
/// border if it ends there and no fold next to the point explains that. Pieces and judgement: those of the method arris
/// (docs/methods-arris.md), on one ball. Law: bits depend on the set of points only.
PointContour judge_seam(const BallPoints& points, double radius, const SeamQuestion& question, RimScratch& scratch);

}  // namespace arris
