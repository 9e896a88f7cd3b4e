#include "pipeline/tile_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "pipeline/run_support.h"

namespace arris::pipeline {
namespace {

/// Per stored point, at most, of tiles that are being built: spool and tile file exist together.
constexpr double kTileFileBytesPerPoint = 24.0;
/// A cell with more than 1/64 of the points that fit into a tile makes halos too large, which hold whole cells.
constexpr std::uint64_t kCellsOfATile = 64;
constexpr std::uint64_t kLikelyBytesPerTile = 48 * 1024;
constexpr std::uint64_t kMostBytesPerTile = 64 * 1024;
constexpr double kTileFileLikelyBytes = 15.0;  // Per stored point.

tiling::TilePlan plan_tiles_around_crowds(const tiling::Survey& survey, const tiling::PlanRequest& request,
                                          io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel) {
  tiling::PlanCells cells(survey, request.max_points / kCellsOfATile);
  tiling::TilePlan plan = tiling::plan_tiles(cells, request);
  while (plan.largest_covered_points > request.max_points && cells.refine(inputs, progress, cancel))
    plan = tiling::plan_tiles(cells, request);
  return plan;
}

/// Covered points of the tiles that may be in flight together, the largest first.
std::vector<double> largest_tiles(const TileJob& job) {
  std::vector<double> points;
  for (const tiling::PlannedTile& tile : job.tiles.tiles) points.push_back(static_cast<double>(tile.covered_points));
  const std::size_t most = std::min(points.size(), static_cast<std::size_t>(job.memory.tile_workers));
  std::partial_sort(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(most), points.end(), std::greater<>());
  points.resize(most);
  return points;
}

/// What stays and what threads have of their own: of all tiles in turn, or of one tile alone, which seldom makes all
/// threads use all that they may. Measured.
struct Likely {
  double of_scratch, of_thread, buffers_bytes;
};
Likely likely_of(const TileJob& job) {
  return job.tiles.tiles.size() > 1 ? Likely{1.0, 1.0, 0.0} : Likely{0.2, 0.5, 10.5e6};
}

/// Of the tiles in flight with the scratch of all threads; tiles are not all at their peak together. Measured.
double likely_tiles_bytes(const TileJob& job) {
  constexpr double kOfTile = 0.95;
  const Likely likely = likely_of(job);
  double bytes = likely.of_scratch * static_cast<double>(job.memory.scratch_bytes) + likely.buffers_bytes, share = 1.0;
  for (const double points : largest_tiles(job)) {
    bytes += share * kOfTile * static_cast<double>(job.memory.tile_bytes(static_cast<std::uint64_t>(points)));
    share = job.memory.method.beside_another;
  }
  return bytes;
}

/// On disk, where a tile file goes at once when its tile is analysed: files and results of the tiles in flight; of every
/// other tile its spool or its results.
double likely_followed_bytes(const TileJob& job, const TileNeeds& needs, double points, double stored) {
  const double covered = points * job.tiles.duplication;
  double in_flight = 0.0;  // Share of the scan.
  for (const double tile : largest_tiles(job)) in_flight += tile / covered;
  const double results = points * needs.likely_result_bytes_per_point;
  const double of_others = std::max(stored * needs.stored_bytes_per_point, results);
  return in_flight * (stored * kTileFileLikelyBytes + results) + (1.0 - in_flight) * of_others +
         static_cast<double>(job.memory.tile_workers) * static_cast<double>(kLikelyBytesPerTile);
}

/// What is resident at the peak, as against fixed_bytes and tile_bytes(), which bound it: buffers are seldom full.
/// Measured (bench/README.md).
double likely_peak_bytes(const TileJob& job, double tiles_bytes) {
  constexpr double kProgramBytes = 40e6;  // All that stays where several tiles take the room of the survey in turn.
  constexpr double kThreadBytes = 6e6;    // Of every thread but the first: what is read ahead, a heap of its own.
  constexpr double kGatherBytes =
      87e6;  // Results of a few million points, records and buffers while outputs are written.
  constexpr double kGatherPoints = 3e6;
  constexpr double kOfPeakSoFar = 1.05;
  const double gather = kGatherBytes * std::min(1.0, static_cast<double>(job.survey.points()) / kGatherPoints);
  const auto held = static_cast<double>(job.memory_request.held_bytes);
  const double threads = likely_of(job).of_thread * kThreadBytes * (job.memory_request.threads - 1);
  const double stays = job.tiles.tiles.size() > 1
                           ? std::min(kProgramBytes + held, static_cast<double>(job.memory.resident_bytes))
                           : static_cast<double>(arris::resident_bytes());
  const double peak =
      stays + threads + static_cast<double>(job.memory_request.kept_bytes) + std::max(tiles_bytes, gather);
  return std::max(peak, kOfPeakSoFar * static_cast<double>(peak_resident_bytes()));
}

}  // namespace

void plan_tiles_of(TileJob& job, const TileNeeds& needs, io::InputSet& inputs, const RunRequest& request,
                   ProgressSink& progress, const CancelToken& cancel) {
  tiling::PlanRequest tiles;
  tiles.max_points = job.memory.max_tile_points;
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
  if (job.tiles.tiles.size() <= 1) release_free_memory();  // What the survey has left differs from run to run.
  const double tiles_bytes = likely_tiles_bytes(job);
  job.likely_tiles_bytes = static_cast<std::uint64_t>(tiles_bytes);
  job.predicted_peak_bytes = static_cast<std::uint64_t>(likely_peak_bytes(job, tiles_bytes));
  const auto points = static_cast<double>(job.survey.points());
  const auto bytes = [&](double stored, double per_stored, double per_point, std::uint64_t per_tile) {
    return static_cast<std::uint64_t>(stored * per_stored + points * per_point) + job.tiles.tiles.size() * per_tile +
           needs.further_temp_bytes;
  };
  const double most_stored = points * job.tiles.duplication;
  const double likely_stored = points * (1.0 + (job.tiles.duplication - 1.0) * needs.halo_fill);
  job.predicted_temp_bytes =
      needs.whole_halo ? needs.further_temp_bytes +
                             static_cast<std::uint64_t>(likely_followed_bytes(job, needs, points, likely_stored))
                       : bytes(likely_stored, needs.stored_bytes_per_point, needs.likely_result_bytes_per_point,
                               kLikelyBytesPerTile);
  check_temp_space(bytes(most_stored, needs.stored_bytes_per_point + kTileFileBytesPerPoint,
                         needs.most_result_bytes_per_point, kMostBytesPerTile),
                   request, progress);
}

}  // namespace arris::pipeline
