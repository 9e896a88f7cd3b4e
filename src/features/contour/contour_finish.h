#pragma once
/// @file What is decided of a contour point once it is found: whether a chain needs it, and how its fold is seen.

#include <cstdint>

#include "features/arris/point_analysis.h"

namespace arris {

/// True if no other point of the ball within half a spacing along the contour lies nearer to it, so that the points
/// that pass form one chain along the contour. Equal distances go to the point whose position comes first (x, then y,
/// then z). Each point asks by its own line, so that no second pass over the scan is needed.
/// @param points  the ball around the point of at least 2 spacings.
bool leads_chain(const BallPoints& points, const PointContour& contour);

/// kConvex or kConcave of EdgeClassBit, or 0 if the fold is seen along its side.
/// @param view  from the point to the viewer; any length > 0.
std::uint8_t fold_side(const FoldLine& line, const Vector3& view);

}  // namespace arris
