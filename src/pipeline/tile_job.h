#pragma once
/// @file The part of a plan that every job over tiles of points has: survey, memory, tiles, disk.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/tile_points.h"
#include "features/contour/tile_contours.h"
#include "pipeline/memory_plan.h"
#include "pipeline/run_request.h"
#include "tiling/spool.h"
#include "tiling/survey.h"
#include "tiling/tile_plan.h"

namespace arris::pipeline {

struct TileJob {
  tiling::Survey survey;
  MemoryRequest memory_request;
  MemoryPlan memory;  ///< plan_memory(memory_request).
  tiling::TilePlan tiles;
  std::int64_t farthest_steps = 0;  ///< No query reaches farther than this; 0: halos are whole.
  bool asks_again = false;          ///< See TileNeeds.
  int analyses_at_once = 1;         ///< Of the memory.tile_workers tiles in flight; see TileNeeds::in_turn.
  /// Room for what comes after the tiles: resident at the peak, likely, of tiles in flight that are all analysed at
  /// once.
  std::uint64_t room_after_tiles_bytes = 0;
  std::uint64_t predicted_peak_bytes = 0;
  std::uint64_t predicted_temp_bytes = 0;
};

/// What a method asks of the tiles it works on.
struct TileNeeds {
  std::function<double(double spacing)> halo;  ///< See tiling::PlanRequest.
  double max_radius = 0.0;
  bool whole_halo = false;
  bool asks_again = false;  ///< A query that is asked again may be unproven again, with a greater reach.
  /// Of the tiles in flight only half are analysed at a time, each by several threads, while others are built or end
  /// what one thread does alone. For analyses that take much memory: to touch that of as many tiles as there are
  /// threads costs more than it saves.
  bool in_turn = false;
  /// On disk, likely at the peak, per point of a tile: of its tile file, which waits for queries of other tiles; where
  /// halos are whole, of its spool.
  double stored_bytes_per_point = 14.0;
  double halo_fill = 1.0;  ///< Plans count the cells that a halo meets whole; this share of their points lies in it.
  /// On disk, of results: what scans usually need, and what is asked of the disk before work.
  double likely_result_bytes_per_point = 2.0;  ///< 8 to 30 for one point in ten.
  double most_result_bytes_per_point = 8.0;
  std::uint64_t further_temp_bytes = 0;  ///< On disk at the same time.
  double likely_later_bytes = 0.0;       ///< In memory after the tiles, as far as room_after_tiles_bytes allow.
};

/// Cuts tiles for job.memory, which may lose workers. Reads the inputs again where most points lie in a few cells of
/// the survey. Throws BudgetError if memory or disk cannot do.
void plan_tiles_of(TileJob& job, const TileNeeds& needs, io::InputSet& inputs, const RunRequest& request,
                   ProgressSink& progress, const CancelToken& cancel);

/// What a method leaves to others of a tile; its results it keeps itself.
struct TileOutcome {
  std::vector<UnprovenQuery> unproven;  ///< Ascending ids; they left no trace in the results.
  std::uint64_t isolated = 0;           ///< Queries with too few neighbours.
};

/// What is done with points; called from several threads at once. The queries are the entries listed, or, without a
/// list, the points of points.core. It calls `let_others_begin` when what is left to do needs one thread only.
using TileAnalysis =
    std::function<TileOutcome(const TilePoints& points, std::optional<std::span<const PlacedQuery>> queries,
                              const std::function<void()>& let_others_begin)>;

}  // namespace arris::pipeline
