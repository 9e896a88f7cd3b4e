#include "pipeline/tile_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "pipeline/run_support.h"
#include "pipeline/tile_estimate.h"

namespace arris::pipeline {
namespace {

/// Per stored point, at most, of tiles that are being built: spool and tile file exist together.
constexpr double kTileFileBytesPerPoint = 24.0;
/// A cell with more than 1/64 of the points that fit into a tile makes halos too large, which hold whole cells.
constexpr std::uint64_t kCellsOfATile = 64;
constexpr std::uint64_t kMostBytesPerTile = 64 * 1024;

/// Larger tiles have less halo, but the system has to clear the memory of the first ones: where few follow, that costs
/// more than it saves.
std::uint64_t most_tile_points(std::uint64_t scan_points) {
  constexpr std::uint64_t kWorthIt = 1'200'000, kTiles = 4;
  return std::max(kWorthIt, scan_points / kTiles);
}

tiling::TilePlan plan_tiles_around_crowds(const tiling::Survey& survey, const tiling::PlanRequest& request,
                                          io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel) {
  tiling::PlanCells cells(survey, request.max_points / kCellsOfATile);
  tiling::TilePlan plan = tiling::plan_tiles(cells, request);
  while (plan.largest_covered_points > request.max_points && cells.refine(inputs, progress, cancel))
    plan = tiling::plan_tiles(cells, request);
  return plan;
}

/// How many tiles are in flight, and analysed at a time.
void choose_workers(TileJob& job, const TileNeeds& needs) {
  // Tiles share what threads there are: what is serial in one goes on beside the loops of another.
  job.memory.tile_workers = static_cast<int>(
      std::clamp<std::size_t>(job.tiles.tiles.size(), 1, static_cast<std::size_t>(job.memory.tile_workers)));
  const std::uint64_t largest = job.memory.tile_bytes(job.tiles.largest_covered_points);
  while (job.memory.tile_workers > 1 && largest * job.memory.tile_workers > job.memory.tiles_bytes)
    --job.memory.tile_workers;
  if (largest > job.memory.tiles_bytes) {
    throw BudgetError(
        fmt::format("the densest tile that cannot be split holds {} points and needs {}; run with at least --memory {}",
                    grouped(job.tiles.largest_covered_points), human_bytes(largest),
                    budget_text(least_budget_bytes(job.tiles.largest_covered_points, job.memory_request))));
  }
  job.analyses_at_once = needs.in_turn ? (job.memory.tile_workers + 1) / 2 : job.memory.tile_workers;
}

void predict(TileJob& job, const TileNeeds& needs) {
  if (job.tiles.tiles.size() <= 1) release_free_memory();  // What the survey has left differs from run to run.
  constexpr double kPassBytes = 12e6;  // Batches of a pass, blocks on their way.
  const double room_bytes =
      std::min(static_cast<double>(job.memory.tiles_bytes), likely_tiles_bytes(job, job.memory.tile_workers));
  job.room_after_tiles_bytes = static_cast<std::uint64_t>(std::max(0.0, room_bytes - kPassBytes));
  const double kept_bytes = std::min(needs.likely_later_bytes, static_cast<double>(job.room_after_tiles_bytes));
  const double later_bytes = kept_bytes > 0.0 ? kept_bytes + kPassBytes : 0.0;
  job.predicted_peak_bytes = static_cast<std::uint64_t>(
      likely_peak_bytes(job, std::max(likely_tiles_bytes(job, job.analyses_at_once), later_bytes)));
  job.predicted_temp_bytes = likely_temp_bytes(job, needs);
}

}  // namespace

void plan_tiles_of(TileJob& job, const TileNeeds& needs, io::InputSet& inputs, const RunRequest& request,
                   ProgressSink& progress, const CancelToken& cancel) {
  tiling::PlanRequest tiles;
  tiles.max_points = std::min(job.memory.max_tile_points, most_tile_points(job.survey.points()));
  tiles.max_core_points = request.tile_points_cap;
  tiles.halo = needs.halo;
  tiles.max_radius = needs.max_radius;
  tiles.whole_halo = needs.whole_halo;
  job.tiles = plan_tiles_around_crowds(job.survey, tiles, inputs, progress, cancel);
  job.asks_again = needs.asks_again;
  constexpr double kRounding = 8.0;  // Reaches are rounded up, here and there by a step.
  job.farthest_steps =
      needs.whole_halo ? 0
                       : static_cast<std::int64_t>(std::ceil(needs.max_radius / job.survey.lattice.step + kRounding));

  choose_workers(job, needs);
  predict(job, needs);
  const auto points = static_cast<double>(job.survey.points());
  const double most_bytes = points * job.tiles.duplication * (needs.stored_bytes_per_point + kTileFileBytesPerPoint) +
                            points * needs.most_result_bytes_per_point;
  check_temp_space(
      static_cast<std::uint64_t>(most_bytes) + job.tiles.tiles.size() * kMostBytesPerTile + needs.further_temp_bytes,
      request, progress);
}

}  // namespace arris::pipeline
