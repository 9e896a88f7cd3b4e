#pragma once
/// @file Whether what was measured at a point is a contour.

#include "features/arris/fold_line.h"
#include "features/arris/point_analysis.h"
#include "features/arris/rim_shape.h"

namespace arris {

/// Narrower layers (rms across their longest direction, spacings) are single scan lines.
constexpr double kLeastRimWidth = 0.7;
/// A smaller azimuth gap is no rim.
constexpr double kLeastGap_deg = 105.0;

/// The line that was fitted to a ball, and how the ball's points lie about one plane. Lengths in spacings.
struct FoldFit {
  double radius = 0.0;  ///< Of the ball.
  double all_rms = 0.0;
  double all_count = 0.0;
  FoldLine line;
};

/// True if the fit is a fold next to the point; then `contour` is it, with its score. O(points of the ball).
bool judge_fold(const FoldFit& fit, const BallPoints& points, PointContour& contour);

/// False if judge_rim() would say no whatever measure_beside_gap() finds.
bool may_be_rim(const RimShape& rim);

/// True if the point lies on the rim of its surface; then `contour` is it, with its score.
/// @param noise  with which the rim was measured.
bool judge_rim(const RimShape& rim, double noise, PointContour& contour);

}  // namespace arris
