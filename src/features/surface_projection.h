#pragma once
/// @file Points of supervoxels seen in one plane, and which points are alpha-exposed there.

#include <vector>

#include "features/alpha_exposed.h"
#include "features/labelled_group.h"
#include "features/supervoxel_frame.h"

namespace arris {

/// A growing set of points in one frame. Not thread-safe.
class SurfaceProjection {
 public:
  /// Starts anew. The frame must be defined.
  void begin(const SupervoxelFrame& frame);
  void add(const LabelledGroup& group, const LabelledPart& part);

  /// Widest free range of directions, degrees (alpha_exposed.h), of the point `at` (relative to the group's origin)
  /// among the points that are nearer than 2 alpha in space. Exact coordinates: the result depends on the points only,
  /// not on the origin. O(points).
  double exposure_deg(const Vector3& at, double alpha);

 private:
  SupervoxelFrame frame_;
  std::vector<double> a_, b_, w_;  ///< In the plane, and off it.
  PlaneNeighbours neighbours_;
  AlphaExposure exposed_;
};

}  // namespace arris
