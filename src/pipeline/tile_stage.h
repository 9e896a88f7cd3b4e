#pragma once
/// @file Partition and per-tile work: tiles are built and analysed while later points are still being routed.

#include <filesystem>
#include <vector>

#include "core/cancel.h"
#include "core/memory_budget.h"
#include "io/point_source.h"
#include "pipeline/tile_job.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {

/// What the tile stage leaves for the stages after it.
struct TileStageResult {
  std::vector<std::uint64_t> unproven;  ///< Per tile: queries in "<tile>.queries" that need a wider view.
  std::uint64_t isolated = 0;
  std::uint64_t peak_temp_bytes = 0;  ///< Of all files in the folder.
};

/// Concurrency: the caller's thread routes points and enqueues closed tiles; `tile_workers` threads build, load and
/// analyse them, each holding a reservation of its predicted bytes. Spools of waiting tiles are on disk, so the queue
/// costs no memory. Tile files that no query can need any more are gone (TileRetirement).
TileStageResult run_tile_stage(io::InputSet& inputs, const TileJob& job, const TileAnalysis& analysis,
                               const std::filesystem::path& folder, tiling::TileStore& store, MemoryBudget& budget,
                               ProgressSink& progress, const CancelToken& cancel);

void write_queries(const std::filesystem::path& path, const std::vector<UnprovenQuery>& queries);
std::vector<UnprovenQuery> read_queries(const std::filesystem::path& path);

}  // namespace arris::pipeline
