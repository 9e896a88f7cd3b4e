#pragma once
/// @file How the memory budget is divided before any tile is cut.

#include <cstdint>

#include "features/contour/contour_method.h"

namespace arris::pipeline {

/// Of this process now, and what grids of points will add to it in any case.
std::uint64_t resident_with_grids();

/// What analysing a tile takes beyond the tile itself.
struct MethodBytes {
  double per_point = 0.0;
  double per_thread = kContourBytesPerThread;
  /// Of its bound, what is likely to be resident of a tile while another one is at its peak.
  double beside_another = 0.68;
  /// The same of a tile at its peak, of which the former is a share. Measured.
  double likely_share = 0.94;
};

struct MemoryRequest {
  std::uint64_t budget_bytes = 0;
  int threads = 1;
  std::uint64_t kept_bytes = 0;  ///< What will be resident besides, and is not yet.
  std::uint64_t held_bytes = 0;  ///< What is resident besides program and survey, and stays.
  MethodBytes method{};
};

/// The division. fixed_bytes + tile_workers tiles of max_tile_points fit into the budget.
struct MemoryPlan {
  std::uint64_t budget_bytes = 0;
  std::uint64_t resident_bytes = 0;  ///< resident_with_grids(), when the plan was made.
  std::uint64_t fixed_bytes = 0;     ///< Program, survey, buffers, per-thread scratch.
  std::uint64_t tiles_bytes = 0;     ///< What is left for tiles in flight.
  std::uint64_t spool_buffer_bytes = 0;
  int tile_workers = 1;               ///< Tiles in flight at most.
  std::uint64_t max_tile_points = 0;  ///< Covered points per tile.
  std::uint64_t scratch_bytes = 0;    ///< Of all threads; part of fixed_bytes.
  MethodBytes method;

  /// Predicted peak bytes of one tile of `points` covered points: the larger of building it and of loading and
  /// analysing it.
  std::uint64_t tile_bytes(std::uint64_t points) const;
  /// The most points, up to `most`, of which tile_bytes() is no more than that; 0 if one is too many.
  std::uint64_t points_within(std::uint64_t bytes, std::uint64_t most = std::uint64_t{1} << 40) const;
  /// What points in flight may take once nothing is routed any more, as things stand now; at least tiles_bytes.
  std::uint64_t widen_bytes() const;
};

/// Throws BudgetError with the least budget that would do if not even tiles of kLeastTilePoints fit.
MemoryPlan plan_memory(const MemoryRequest& request);

/// The budget that lets one tile of `points` covered points be processed alone.
std::uint64_t least_budget_bytes(std::uint64_t points, const MemoryRequest& request);

constexpr std::uint64_t kLeastTilePoints = 50'000;
/// Smaller tiles are mostly halo: rather fewer in flight, each analysed by more threads.
constexpr std::uint64_t kFairTilePoints = 1'000'000;

}  // namespace arris::pipeline
