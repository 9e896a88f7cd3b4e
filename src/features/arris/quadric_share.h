#pragma once
/// @file Whether points scatter about a plane or bend away from it.

#include <span>

#include "features/neighbourhood/plane_fit.h"

namespace arris {

/// Rms of the points within `radius` about the quadric over their plane (1, u, v, u², uv, v²), divided by their rms
/// about the plane itself; degrees of freedom are counted, so that it is about 1 for noise. A fold bends: what it
/// leaves is the noise. 1 where the points do not determine a quadric. Law: bits depend on the set of points only
/// (coordinates are rounded to 1/32 spacing, heights to 1/1024). O(points).
/// Of many balls, as many at once as the processor's vectors hold; same bits however many.
/// @param planes  fitted to the same points. @param shares  as many as balls.
void quadric_shares(std::span<const BallPoints* const> balls, double radius, std::span<const FittedPlane> planes,
                    std::span<double> shares);

}  // namespace arris
