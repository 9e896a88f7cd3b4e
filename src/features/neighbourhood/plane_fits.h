#pragma once
/// @file Planes through several sets of points at once.

#include <span>

#include "features/neighbourhood/plane_fit.h"

namespace arris {

/// fit_plane() of each, as many at once as the processor's vectors hold; same bits. As many `planes` as sums.
void fit_planes(std::span<const PointSums> sums, std::span<FittedPlane> planes);

}  // namespace arris
