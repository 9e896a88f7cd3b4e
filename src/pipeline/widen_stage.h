#pragma once
/// @file Answers the queries that a tile's halo could not prove, with points from its neighbours' files.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/cancel.h"
#include "pipeline/tile_job.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {

struct WidenResult {
  std::uint64_t queries = 0;
  std::uint64_t isolated = 0;
};

/// For groups of unproven queries, in the order of tiles: collects the points of all tiles that lie in reach of any of
/// them, and asks again. What is collected is bounded by the largest tile the budget allows; groups that need more are
/// halved. Sequential over groups, parallel inside.
WidenResult run_widen_stage(const TileJob& job, const std::vector<std::uint64_t>& unproven,
                            const TileAnalysis& analysis, const std::filesystem::path& folder,
                            const tiling::TileStore& store, ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
