#pragma once
/// @file Points near the borders of segments go to the planes they are nearest to (Yu et al.).

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/cancel.h"
#include "features/segment/segment_parameters.h"
#include "merge/duplicate_points.h"
#include "merge/point_labels.h"
#include "merge/segment_frontier.h"
#include "merge/segment_moments.h"

namespace arris::merge {

/// d_re where the user gives none: within max(3 RMS, kLeastReassign s), but at most kMostReassign s, s being the
/// segment's spacing. The paper gives no value.
constexpr double kReassignRms = 3.0;
constexpr double kLeastReassign = 0.15;
constexpr double kMostReassign = 0.35;
/// Segments with a larger RMS, in spacings, are curved: their points are not where their plane is, and do not leave for
/// another one.
constexpr double kMostPlanarRms = 0.5;
/// Not as published: what a segment flatter than this, in spacings, holds farther off than d_re and kStrayRms RMS goes.
constexpr double kMostFlatRms = 0.15;
constexpr double kStrayRms = 4.0;

struct ReassignmentSetup {
  const SegmentParameters& parameters;
  double lattice_step = 1.0;
  std::filesystem::path folder;  ///< For the changes of a sweep.
};

/// One sweep. Every frontier point looks at the segments of its neighbours (and, not as published, at its own): the
/// plane at the least distance takes it, if that is at most d_re (ties: the smaller number); what is too far from its
/// own flat plane and is taken by none is in no segment. As published only points without a segment do so. All decide
/// by the labels and planes from before the sweep, so no order matters; then labels, moments and planes are brought up
/// to date.
/// @param planes  one per segment; spacing set. @return points that changed.
std::uint64_t reassign(const ReassignmentSetup& setup, const SegmentFrontier& frontier,
                       const DuplicatePoints& duplicates, PointLabels& labels, SegmentMoments& moments,
                       std::vector<SegmentPlane>& planes, const CancelToken& cancel);

}  // namespace arris::merge
