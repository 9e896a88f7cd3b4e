#pragma once
/// @file Points near the plane of a segment, projected on it, and what their alpha shape is around one of them.

#include <vector>

#include "features/planar/alpha_edges.h"
#include "features/planar/alpha_exposed.h"
#include "features/planar/plane_frame.h"
#include "features/segment_contours/segment_task.h"

namespace arris {

/// A growing set of points of one group in the plane of one segment; points outside of the segment's slab are left out.
/// Exact coordinates: results depend on the points only, not on the group's origin. Points far from the queries are
/// projected when the near ones do not settle a question. Not thread-safe.
class ShapeProjection {
 public:
  /// Both must outlive it; the group may be gathered anew before begin().
  ShapeProjection(const SegmentTask& task, const LabelledGroup& group) : task_(task), group_(group) {}

  /// Starts anew. @param box  that the group was gathered around: questions are about points in it.
  void begin(std::uint32_t label, const ClosedBox& box);
  void add(const LabelledPart& part);
  std::uint32_t label() const { return label_; }
  const SegmentLengths& lengths() const { return lengths_; }

  /// True only if the point `at` (relative to the group's origin, in the slab) is not exposed; false says nothing.
  bool surely_inside(const Vector3& at);
  /// Widest free range of directions, degrees (alpha_exposed.h). O(points).
  double exposure_deg(const Vector3& at);
  /// The outline's edges that leave the point in `slot`: targets, whose index is their slot. None if another point at
  /// the same place in the plane has a smaller id; of targets at the same place the one with the smallest id counts.
  const std::vector<PlanarNeighbour>& edges(std::uint32_t slot);

 private:
  struct Columns {
    std::vector<double> a, b;
    std::vector<std::uint32_t> slot;
    std::size_t size = 0;

    void make_room(std::size_t count);
  };
  void project(std::size_t index, Columns& points) const;
  void complete();
  void find_neighbours(const Columns& points, const Vector3& at);

  const SegmentTask& task_;
  const LabelledGroup& group_;
  std::uint32_t label_ = 0;
  double near_radius_ = 0.0;           ///< Of the ball around the middle of the box.
  std::vector<LabelledPart> pending_;  ///< Not in all_ yet.
  PlaneFrame frame_;
  SegmentLengths lengths_;
  Columns near_, all_;
  PlaneNeighbours neighbours_;
  AlphaExposure exposed_;
  AlphaEdges edges_;
  std::vector<PlanarNeighbour> around_, none_;
};

}  // namespace arris
