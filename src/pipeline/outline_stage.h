#pragma once
/// @file Contours and outlines of segments: a second look at the scan, tile by tile, with labels and planes.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/segment_contours/segment_contour_parameters.h"
#include "io/point_source.h"
#include "merge/outline_rings.h"
#include "merge/result_spool.h"
#include "pipeline/segment_planes.h"
#include "pipeline/tile_job.h"

namespace arris::pipeline {

struct OutlineSetup {
  const RunRequest& request;
  const SegmentContourParameters& parameters;
  const PlanarSegments& segments;
  std::filesystem::path folder;
};

struct OutlineResult {
  std::vector<merge::SegmentOutline> outlines;  ///< If the parameters ask for them.
  std::uint64_t peak_temp_bytes = 0;
};

/// @param job  its survey; memory and tiles are planned anew for the halo that the segments ask for.
/// Adds the contour points to `results`. All outline edges (about 64 bytes each) are in memory.
OutlineResult outline_segments(io::InputSet& inputs, TileJob& job, const OutlineSetup& setup,
                               merge::ResultSpool& results, ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
