#pragma once
/// @file Planes through neighbourhoods that do not follow the outliers (Yu et al., after Rusu).
///
/// C = sum xi_i (p_i - m)(p_i - m)^T / sum xi_i with the weighted mean m; the normal belongs to the least eigenvalue.
/// Start: least median of squares. xi = 1 within d_max of that plane; beyond, as published, exp(-d^2 / mu^2), mu being
/// the mean distance of the neighbours. That lets neighbours on the other slope of a roof count for much; not as
/// published xi = exp(1 - d^2 / d_max^2), and the weights are worked out again about the plane that they gave.
/// d_max = max(2.5 * 1.4826 * median |d|, kInlierShare mu).
///
/// Laws: bits depend on the neighbours' positions and their order by distance only, lane by lane, at every vector
/// width.

#include "features/segment/median_plane.h"
#include "features/segment/neighbourhood_batch.h"

namespace arris {

/// Points this near to the plane, in mean distances, are never outliers.
constexpr double kInlierShare = 0.15;

struct PlaneWeights {
  double inlier_steps = 0.0;  ///< d_max; 0: by the rule above.
  bool published = false;
};

/// All weights 1.
void fit_plain_planes(const NeighbourhoodBatch& batch, PlaneBatch& planes);

/// @param plan  of batch.neighbours.
void fit_robust_planes(const NeighbourhoodBatch& batch, const MedianPlan& plan, const PlaneWeights& weights,
                       PlaneBatch& planes);

}  // namespace arris
