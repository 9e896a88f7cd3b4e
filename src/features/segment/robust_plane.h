#pragma once
/// @file Planes through neighbourhoods that do not follow the outliers (Yu et al., eq. of section 3.1, after Rusu).
///
/// C = sum xi_i (p_i - m)(p_i - m)^T / sum xi_i with the weighted mean m; the normal belongs to the least eigenvalue.
/// Start: least median of squares. Then a few rounds of weights: xi = 1 within d_max of the plane, exp(-d^2 / mu^2)
/// beyond, mu being the mean distance of the neighbours. d_max = max(2.5 * 1.4826 * median |d|, kInlierShare mu).
///
/// Laws: bits depend on the neighbours' positions and their order by distance only, lane by lane, at every vector
/// width.

#include "features/segment/median_plane.h"
#include "features/segment/neighbourhood_batch.h"

namespace arris {

/// Points this near to the plane, in mean distances, are never outliers: there exp(-d^2 / mu^2) is above 0.99.
constexpr double kInlierShare = 0.1;
constexpr int kWeightRounds = 3;

/// All weights 1.
void fit_plain_planes(const NeighbourhoodBatch& batch, PlaneBatch& planes);

/// @param plan   of batch.neighbours.
/// @param d_max  inlier distance, steps; 0: by the rule above.
void fit_robust_planes(const NeighbourhoodBatch& batch, const MedianPlan& plan, double d_max, PlaneBatch& planes);

}  // namespace arris
