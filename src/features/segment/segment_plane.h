#pragma once
/// @file The plane of a segment, as the stages after region growing see it.

#include "core/lattice.h"
#include "features/numerics/symmetric_eigen3.h"

namespace arris {

/// Points p with normal . (p - centroid) = 0; all lengths in lattice steps. Segment i (labels are 1, 2, ...; 0: none)
/// is entry i - 1 of a table of planes.
struct SegmentPlane {
  Vector3 normal{0.0, 0.0, 1.0};  ///< Unit vector; of the two, the one with the greater z (then y, then x).
  Vector3 centroid{};             ///< Absolute.
  double rms = 0.0;               ///< Root of the mean squared distance of the segment's points to the plane.
  double spacing = 0.0;           ///< Side of the square that one point has for itself, > 0.
};

/// Above 0 on the side that the normal points to, steps.
inline double signed_distance(const SegmentPlane& plane, const LatticePoint& p) {
  return plane.normal[0] * (p.x - plane.centroid[0]) + plane.normal[1] * (p.y - plane.centroid[1]) +
         plane.normal[2] * (p.z - plane.centroid[2]);
}

}  // namespace arris
