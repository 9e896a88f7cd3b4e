#pragma once
/// @file Points of supervoxels seen in one plane, and which points are alpha-exposed there.

#include <vector>

#include "features/planar/alpha_exposed.h"
#include "features/planar/labelled_group.h"
#include "features/zheng/supervoxel_frame.h"

namespace arris {

/// A growing set of points of one group in one frame. Not thread-safe.
class SurfaceProjection {
 public:
  /// Starts anew. The frame must be defined.
  void begin(const SupervoxelFrame& frame);
  void add(const LabelledGroup& group, const LabelledPart& part);
  /// Announces questions about points in the box that the group was gathered around: what lies in and next to it is
  /// tried first. Speed only: what some neighbours block stays blocked.
  void expect(const ClosedBox& box);

  /// Widest free range of directions, degrees (alpha_exposed.h), of the point `at` (relative to the group's origin)
  /// among the points that are nearer than 2 alpha in space. Exact coordinates: the result depends on the points only,
  /// not on the origin. O(points).
  double exposure_deg(const Vector3& at, double alpha);

 private:
  /// In the plane, and off it.
  struct Columns {
    std::vector<double> a, b, w;
    std::size_t size = 0;
  };
  void find_neighbours(const Columns& points, const Vector3& at, double alpha);

  SupervoxelFrame frame_;
  Columns all_, near_;
  PlaneNeighbours neighbours_;
  AlphaExposure exposed_;
};

}  // namespace arris
