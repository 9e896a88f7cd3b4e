#pragma once
/// @file The smooth surface that could explain a ball as well as a fold does: what columns and vaults are.

#include "features/arris/fold_line.h"

namespace arris {

/// Rms distance, spacings, of the points to the quadric w = c + b v + d v² + a t + k t² that fits them best; t runs
/// along the line, w along its opening, v across both. The distance is taken along w and reduced by the slope of the
/// fold's arms, so that it compares with FoldLine::rms. Infinite if the points do not determine the surface. Law: bits
/// depend on the set of points only (coordinates are rounded to 1/32 spacing, w to 1/1024). O(points).
double curved_surface_rms(const BallPoints& points, const FoldLine& line);

}  // namespace arris
