#pragma once
/// @file What arris's own method says of one point, from the balls around it.

#include "features/arris/fold_line.h"
#include "features/arris/rim_shape.h"
#include "features/neighbourhood/ball_points.h"
#include "features/neighbourhood/plane_fit.h"

namespace arris {

/// Radii of the balls that are looked at, in spacings: the first always, the others where noise hides the surface.
constexpr double kBallRadii[] = {5.0, 9.0, 13.0};
/// A ball whose points lie about a plane with less than this rms, spacings, holds no fold of up to 150 degrees.
constexpr double kFlatRms = 0.25;
/// The small ball that says whether anything happens next to the point itself.
constexpr double kNearRadius = 3.0;
/// Below this rms the near ball holds no fold of up to 150 degrees within a spacing of the point.
constexpr double kNearFlatRms = 0.1;
/// A near ball that is narrower (rms across its longest direction) is a string of points: it says nothing of surfaces.
constexpr double kLeastNearWidth = 0.7;
/// Share of a ball's radius by which the points' mean must be off the centre for a rim within a spacing of it.
constexpr double kCentredShare = 0.15;
constexpr double kNearCentredShare = 0.1;
/// More points than this in a ball are not a surface seen at its spacing.
constexpr double kMostBallPoints = 16384.0;
constexpr double kLeastBallMembers = 6.0;
/// Noise above this rms, spacings, is not told from other scatter.
constexpr double kMostNoise = 0.85;

/// A contour found at the point.
struct PointContour {
  enum class Kind : std::uint8_t { kNone, kBoundary, kFold } kind = Kind::kNone;
  double score = 0.0;  ///< [0, 1]: the probability that an edge passes within a spacing.
  double gap_deg = 0.0;
  FoldLine line;               ///< Of a fold.
  Vector3 nearest{0, 0, 0};    ///< The nearest point of the contour, spacings, relative to the point.
  Vector3 direction{1, 0, 0};  ///< Along the contour.
  double line_spacing = 1.0;   ///< Spacing along the arms, in units of the point's own estimate.
};

/// Gives the balls around the point on demand; null if the ball is not known to be complete.
class BallProvider {
 public:
  virtual const BallPoints* ball(int level) = 0;

 protected:
  ~BallProvider() = default;
};

/// What is known of the point before any ball is collected.
struct PointProspects {
  double rms = 0.0;         ///< Of the first ball about its plane, spacings.
  double near_rms = 0.0;    ///< Of the near ball.
  double off_centre = 1.0;  ///< Distance of the mean of the first ball from its centre, radii.
  bool fold = true;         ///< Folds are possible.
  bool scatter = false;     ///< The points of the first ball scatter about a plane (scatter.h).
};

/// Reusable memory.
struct AnalysisScratch {
  RimScratch rim;
};

/// The analysis of one point: folds first, then boundaries. Source: docs/methods-arris.md.
/// @return false if a ball that was needed is not known to be complete; `contour` then means nothing.
bool analyse_point(const PointProspects& prospects, BallProvider& balls, AnalysisScratch& scratch, bool want_fold,
                   bool want_boundary, PointContour& contour);

}  // namespace arris
