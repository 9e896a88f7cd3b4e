#pragma once
/// @file The local point spacing, from the neighbours of one point.

#include "features/neighbourhood/nearest_select.h"

namespace arris {

/// Lengths in steps; 0 without neighbours. Law: adding points to the cloud never increases either (distances of sorted
/// neighbours only shrink, and every operation is monotone), as long as the number of neighbours stays the same.
struct LocalSpacing {
  double nearest = 0.0;  ///< Mean distance to the 6 nearest neighbours: the scale of d_thr.
  double density = 0.0;  ///< Side of the square that one point has for itself: the scale of the ball and of C'_f1.
};

/// The density spacing is the mean over the farther half of the neighbours of sqrt(pi r_j² / j): on a surface, j
/// neighbours within r_j share a disc. One distance alone scatters more; near neighbours scatter most and feel noise
/// off the surface.
LocalSpacing local_spacing(const Neighbours& neighbours);

}  // namespace arris
