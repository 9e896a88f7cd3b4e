#pragma once
/// @file The surface that a point lies on, told from others close by.

#include <vector>

#include "features/neighbourhood/plane_fit.h"

namespace arris {

/// Reusable memory.
struct LayerScratch {
  struct Near {
    double d2, x, y, z;
  };
  std::vector<Near> nearest;
  std::vector<FittedPlane> candidates;
  BallPoints disc;
};

/// The plane of the layer that holds the centre, found from the centre outwards: a plane through its nearest
/// neighbours, then refits on growing discs with the points farther than `gate` left out. Where the neighbours do not
/// lie in a plane (another layer is near), the first plane is the one through the centre and two of its nearest
/// neighbours that has most points about it: layers 2 spacings apart do not mix. Law: bits depend on the set of points
/// only. O(points).
/// @param radius  of the largest disc, spacings, at most the ball's.
FittedPlane own_layer(const BallPoints& points, double radius, double gate, LayerScratch& scratch);

}  // namespace arris
