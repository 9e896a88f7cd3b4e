#pragma once
/// @file From grown segments to the final ones: planes over the whole scan, reassignment, final numbers.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/cancel.h"
#include "core/lattice.h"
#include "core/progress.h"
#include "features/segment/segment_parameters.h"
#include "io/point_source.h"
#include "merge/duplicate_points.h"
#include "merge/segment_frontier.h"
#include "merge/segment_growth.h"
#include "merge/segment_moments.h"

namespace arris::pipeline {

/// Segments 1 .. planes.size(), in the order of their smallest ids.
struct PlanarSegments {
  merge::PointLabels labels;
  std::vector<SegmentPlane> planes;
  std::vector<std::uint64_t> points;  ///< Of each segment, duplicates counted.
  std::uint64_t labelled = 0;
  std::uint64_t reassigned = 0;
};

struct PlaneSetup {
  const Lattice& lattice;
  const SegmentParameters& parameters;
  std::filesystem::path folder;
};

/// Reads the inputs once for the moments. Segments that lose so many points that fewer than min_points are left are
/// none.
PlanarSegments settle_segments(io::InputSet& inputs, const PlaneSetup& setup, merge::GrownSegments grown,
                               const merge::SegmentFrontier& frontier, const merge::DuplicatePoints& duplicates,
                               ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
