#pragma once
/// @file Least-squares planes through parts of a ball.

#include <limits>

#include "features/neighbourhood/ball_points.h"
#include "features/numerics/symmetric_eigen3.h"

namespace arris {

/// Exact sums over points, whatever their order.
struct PointSums {
  double n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  bool operator==(const PointSums&) const = default;
};

/// normal . p = offset; a frame with it, and how the points spread.
struct FittedPlane {
  Vector3 normal{0, 0, 1};
  double offset = 0.0;
  Vector3 centroid{0, 0, 0};
  Vector3 e1{1, 0, 0}, e2{0, 1, 0};  ///< In the plane, e1 along the widest spread.
  double rms = 0.0;                  ///< Of the distances to the plane.
  double middle_rms = 0.0;           ///< Of the spread along e2.
  double count = 0.0;

  double distance(double x, double y, double z) const {  ///< Signed.
    return normal[0] * x + normal[1] * y + normal[2] * z - offset;
  }
};

/// Needs sums.n >= 1. Fewer than three points, or collinear ones, leave the normal to the eigen-solver's fixed rule.
FittedPlane fit_plane(const PointSums& sums);

/// Sums over all points of the ball.
PointSums sum_all(const BallPoints& points);
/// Sums over the points within `radius` of the centre.
PointSums sum_within(const BallPoints& points, double radius);
/// Of those, the points no farther than `gate` from the plane.
PointSums sum_near_plane(const BallPoints& points, double radius, const FittedPlane& plane, double gate);

/// How many these are.
double count_near_plane(const BallPoints& points, double radius, const FittedPlane& plane, double gate);

/// An oriented plane g . p = h that parts the ball: points with g . p > h are on side a.
struct Split {
  Vector3 g{1, 0, 0};
  double h = 0.0;
};

/// Sums over side a of a split.
PointSums sum_side(const BallPoints& points, const Split& split);
struct SplitSums {
  PointSums a, b;
};
/// Sums on both sides of a split over the points no farther than `gate` from the plane of their side.
SplitSums sum_split(const BallPoints& points, const Split& split, const FittedPlane& a, const FittedPlane& b,
                    double gate);
/// Mean of the squared distances of all points to the plane of their side, distances cut at `most`.
double mean_cut_square(const BallPoints& points, const Split& split, const FittedPlane& a, const FittedPlane& b,
                       double most);

}  // namespace arris
