#pragma once
/// @file Whether a seam between supervoxels, or a border that a seam may explain, is a contour.

#include "features/arris/point_analysis.h"

namespace arris {

/// What supervoxels say of a point.
struct SeamQuestion {
  bool fold = false;              ///< A fold may pass: supervoxels that are not coplanar meet near the point.
  bool border = false;            ///< The surface ends at the point: it is alpha-exposed.
  double least_turn_deg = 0.0;    ///< Less is no fold.
  double rms = 0.0;               ///< Of the first ball's points about one plane, spacings.
  double radius[2] = {0.0, 0.0};  ///< Of the balls, spacings, ascending.
};

/// Asks the points themselves, whatever their labels: two planes that explain the first ball around the point (where
/// that is noisy: the second) better than one, and whose line passes the point, are a fold; otherwise the layer that
/// holds the point is a border if it ends there and no fold next to the point explains that. Pieces and judgement:
/// those of the method arris (docs/methods-arris.md). Law: bits depend on the set of points only.
/// @param balls  gives the ball of radius[level] around the point.
PointContour judge_seam(const SeamQuestion& question, BallProvider& balls, RimScratch& scratch);

}  // namespace arris
