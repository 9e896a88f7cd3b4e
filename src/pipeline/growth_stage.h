#pragma once
/// @file Segments of the whole scan from growth in its tiles.

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/segment/segment_parameters.h"
#include "io/point_source.h"
#include "merge/duplicate_points.h"
#include "merge/segment_frontier.h"
#include "merge/segment_growth.h"
#include "pipeline/run_support.h"
#include "pipeline/tile_job.h"

namespace arris::pipeline {

struct GrowthSetup {
  const TileJob& job;
  const SegmentParameters& parameters;
  std::span<const std::uint8_t> intensities;  ///< By point id, or empty.
  std::filesystem::path folder;
  Stopwatch& watch;  ///< Gets "tiles", "widen" and "join".
};

struct GrowthResult {
  merge::GrownSegments segments;
  std::uint64_t isolated = 0;
  std::uint64_t widened_queries = 0;
  std::uint64_t peak_temp_bytes = 0;
};

/// Fills frontier and duplicates. Tile files are gone when this returns.
GrowthResult grow_segments(io::InputSet& inputs, const GrowthSetup& setup, merge::SegmentFrontier& frontier,
                           merge::DuplicatePoints& duplicates, ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
