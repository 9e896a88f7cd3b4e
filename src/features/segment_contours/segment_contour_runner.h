#pragma once
/// @file Contours and outline edges of segments for the queries of one bucket after the other; one runner per thread.

#include <cstdint>
#include <span>
#include <vector>

#include "features/contour/found_records.h"
#include "features/contour/tile_contours.h"
#include "features/segment_contours/outline_edge.h"
#include "features/segment_contours/segment_fold.h"
#include "features/segment_contours/shape_projection.h"

namespace arris {

/// Not thread-safe; make one per thread.
class SegmentContourRunner {
 public:
  explicit SegmentContourRunner(const SegmentTask& task) : task_(task), own_(task_, group_), joined_(task_, group_) {}
  SegmentContourRunner(const SegmentContourRunner&) = delete;
  SegmentContourRunner& operator=(const SegmentContourRunner&) = delete;

  /// `slots`: queries that are close together, in tree order.
  void run(std::span<const std::uint32_t> slots);

  const FoundRecords& found() const { return found_; }
  const std::vector<OutlineEdge>& edges() const { return edges_; }
  std::vector<UnprovenQuery> take_unproven() { return {}; }  ///< The halo covers every support.

 private:
  struct Query {
    std::uint32_t label, slot;
  };
  /// Queries of one segment.
  void run_segment(std::span<const Query> run, const ClosedBox& box);
  SegmentFold best_fold(std::uint32_t slot) const;
  double border_deg(const Vector3& at, const ClosedBox& box);
  void add_edges(std::uint32_t slot);
  ContourRecord fold_record(std::uint32_t slot, const SegmentFold& fold) const;
  ContourRecord border_record(std::uint32_t slot, double free_deg) const;

  SegmentTask task_;
  LabelledGroup group_;
  std::vector<Query> queries_;
  std::vector<PlaneMeeting> meetings_;   ///< Of the segment at work, with those around that it may fold to.
  std::vector<std::uint32_t> continue_;  ///< Segments around that go on where it ends.
  ShapeProjection own_, joined_;         ///< The segment alone, and with those that continue it.
  bool joined_known_ = false;
  FoundRecords found_;
  std::vector<OutlineEdge> edges_;
};

}  // namespace arris
