#pragma once
/// @file The fold in which two segments meet, seen from a point of one of them.

#include "features/arris/fold_line.h"
#include "features/segment_contours/segment_task.h"

namespace arris {

/// Two planes at an angle.
struct PlaneMeeting {
  std::uint32_t own = 0, other = 0;  ///< Labels.
  double cosine = 0.0;               ///< Of the normals, signed.
  double sine2 = 0.0;
  double angle_deg = 0.0;  ///< Between the planes, [0, 90].
};

PlaneMeeting plane_meeting(const SegmentTask& task, std::uint32_t own, std::uint32_t other);

struct SegmentFold {
  bool explains = false;  ///< A supported fold is so near that the segment may end here.
  double score = 0.0;     ///< > 0: the point is a fold point.
  Vector3 to_line{};      ///< From the point to the nearest one of the line, steps.
  FoldLine line;          ///< Only direction, opening and angle_deg.
};

/// @param slot  a point of the own segment; the group holds what is within its reach.
/// The bits are a function of positions, labels and planes. O(points of both segments in the group), O(1) far from the
/// line.
SegmentFold fold_at(const SegmentTask& task, const LabelledGroup& group, const PlaneMeeting& meeting,
                    std::uint32_t slot);

}  // namespace arris
