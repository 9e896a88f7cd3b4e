#include "pipeline/tile_job.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "pipeline/run_support.h"

namespace arris::pipeline {
namespace {

/// Per stored point: the spool record and its copy in the tile file (both exist while a tile is built).
constexpr double kSpoolBytesPerPoint = 20.0;
constexpr double kTileFileBytesPerPoint = 24.0;
constexpr std::uint64_t kBytesPerTile = 64 * 1024;

}  // namespace

void plan_tiles_of(TileJob& job, const TileNeeds& needs, const RunRequest& request, ProgressSink& progress) {
  tiling::PlanRequest tiles;
  tiles.max_points = job.memory.max_tile_points;
  tiles.max_core_points = request.tile_points_cap;
  tiles.halo = needs.halo;
  tiles.max_radius = needs.max_radius;
  tiles.whole_halo = needs.whole_halo;
  job.tiles = tiling::plan_tiles(job.survey, tiles);

  // Few tiles leave threads idle: then one tile at a time uses all of them inside.
  if (job.tiles.tiles.size() < 4 * static_cast<std::size_t>(job.memory.tile_workers)) job.memory.tile_workers = 1;
  const std::uint64_t largest = job.memory.tile_bytes(job.tiles.largest_covered_points);
  while (job.memory.tile_workers > 1 && largest * job.memory.tile_workers > job.memory.tiles_bytes)
    --job.memory.tile_workers;
  if (largest > job.memory.tiles_bytes) {
    throw BudgetError(
        fmt::format("the densest tile that cannot be split holds {} points and needs {}; run with at least --memory {}",
                    grouped(job.tiles.largest_covered_points), human_bytes(largest),
                    human_bytes(least_budget_bytes(job.tiles.largest_covered_points, job.memory_request))));
  }
  job.predicted_peak_bytes = job.memory.fixed_bytes + largest * static_cast<std::uint64_t>(job.memory.tile_workers);
  const double stored = static_cast<double>(job.survey.points()) * job.tiles.duplication;
  job.predicted_temp_bytes =
      static_cast<std::uint64_t>(stored * (kSpoolBytesPerPoint + kTileFileBytesPerPoint) +
                                 static_cast<double>(job.survey.points()) * needs.result_bytes_per_point) +
      job.tiles.tiles.size() * kBytesPerTile + needs.further_temp_bytes;
  check_temp_space(job.predicted_temp_bytes, request, progress);
}

}  // namespace arris::pipeline
