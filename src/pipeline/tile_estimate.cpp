#include "pipeline/tile_estimate.h"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "core/process_memory.h"
#include "pipeline/tile_retirement.h"

namespace arris::pipeline {
namespace {

constexpr double kLikelyBytesPerTile = 48.0 * 1024.0;
constexpr double kTileFileLikelyBytes = 15.0;  // Per stored point.

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
  return job.tiles.tiles.size() > 1 ? Likely{1.0, 1.0, 0.0} : Likely{0.2, 0.5, 15.5e6};
}

/// On disk, where a tile file goes at once when its tile is analysed: files and results of the tiles in flight; of
/// every other tile its spool or its results.
double likely_followed_bytes(const TileJob& job, const TileNeeds& needs, double points, double stored) {
  const double covered = points * job.tiles.duplication;
  double in_flight = 0.0;  // Share of the scan.
  for (const double tile : largest_tiles(job)) in_flight += tile / covered;
  const double results = points * needs.likely_result_bytes_per_point;
  const double of_others = std::max(stored * needs.stored_bytes_per_point, results);
  return in_flight * (stored * kTileFileLikelyBytes + results) + (1.0 - in_flight) * of_others +
         static_cast<double>(job.memory.tile_workers) * kLikelyBytesPerTile;
}

/// Of the tiles that wait, those which some query may ask for. Queries that ask again reach far: the larger the cores
/// beside that, the likelier. Of many small tiles more are done with early. Measured.
double likely_unproven_share(const TileJob& job) {
  constexpr double kAskedOnce = 0.74, kAskedOnceOfSmall = 0.6, kEvenSquares = 1.2;
  constexpr std::size_t kManyTiles = 50, kSmallTilePoints = 400'000;
  const std::size_t tiles = job.tiles.tiles.size();
  const bool many_small = tiles > kManyTiles && job.survey.points() / tiles < kSmallTilePoints;
  if (!job.asks_again) return many_small ? kAskedOnceOfSmall : kAskedOnce;
  const auto reach = static_cast<double>(job.farthest_steps);
  double area = 0.0;
  for (const tiling::PlannedTile& tile : job.tiles.tiles) {
    std::array<double, 3> side{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      side[axis] = static_cast<double>(tile.core.max[axis] - tile.core.min[axis]);
    std::ranges::sort(side);
    area += side[1] * side[2];
  }
  const double squares = area / static_cast<double>(job.tiles.tiles.size()) / (reach * reach);
  return squares / (squares + kEvenSquares);
}

/// On disk, where tile files wait for the queries of the tiles around them. If all queries are proven a file goes when
/// all tiles are analysed that may ask for it; if none is, all files stay. Scans lie between.
double likely_waiting_bytes(const TileJob& job, const TileNeeds& needs, double points, double stored) {
  constexpr double kSpoolBytes = 7.0;  // Per stored point.
  const double all = stored * needs.stored_bytes_per_point + points * needs.likely_result_bytes_per_point +
                     static_cast<double>(job.tiles.tiles.size()) * kLikelyBytesPerTile;
  const double of_covered = stored / (points * job.tiles.duplication);
  const auto stored_of = [&](std::size_t tile) {
    return of_covered * static_cast<double>(job.tiles.tiles[tile].covered_points);
  };
  TileRetirement retirement(job.tiles, job.farthest_steps, job.asks_again);
  double now = kSpoolBytes * stored, peak = now;
  for (std::size_t tile = 0; tile < job.tiles.tiles.size(); ++tile) {
    now += (needs.stored_bytes_per_point - kSpoolBytes) * stored_of(tile);
    now += needs.likely_result_bytes_per_point * static_cast<double>(job.tiles.tiles[tile].core_points);
    peak = std::max(peak, now);
    for (const std::size_t gone : retirement.analysed(tile, {})) now -= needs.stored_bytes_per_point * stored_of(gone);
  }
  const double unproven = likely_unproven_share(job);
  return unproven * all + (1.0 - unproven) * peak;
}

}  // namespace

/// Tiles are not all at their peak together. Measured.
double likely_tiles_bytes(const TileJob& job, int analyses) {
  constexpr double kWhileBuilt = 0.335;  // Of its bound, of a tile that waits for its turn.
  const Likely likely = likely_of(job);
  double bytes = likely.of_scratch * static_cast<double>(job.memory.scratch_bytes) + likely.buffers_bytes;
  int tile = 0;
  for (const double points : largest_tiles(job)) {
    const double share = tile == 0 ? 1.0 : tile < analyses ? job.memory.method.beside_another : kWhileBuilt;
    bytes += share * job.memory.method.likely_share *
             static_cast<double>(job.memory.tile_bytes(static_cast<std::uint64_t>(points)));
    ++tile;
  }
  return bytes;
}

/// As against fixed_bytes and tile_bytes(), which bound it: buffers are seldom full. Measured (bench/README.md).
double likely_peak_bytes(const TileJob& job, double tiles_bytes) {
  constexpr double kProgramBytes = 38.5e6;  // All that stays where several tiles take the room of the survey in turn.
  constexpr double kThreadBytes = 4.5e6;    // Of every thread but the first: what is read ahead, a heap of its own.
  constexpr double kGatherBytes =
      87e6;  // Results of a few million points, records and buffers while outputs are written.
  constexpr double kGatherPoints = 3e6;
  constexpr double kSurveyReused = 0.6;  // Of its counts, which are gone when a lone tile is analysed.
  constexpr double kOfPeakSoFar = 1.05;
  const double gather = kGatherBytes * std::min(1.0, static_cast<double>(job.survey.points()) / kGatherPoints);
  const auto held = static_cast<double>(job.memory_request.held_bytes);
  const double threads = likely_of(job).of_thread * kThreadBytes * (job.memory_request.threads - 1);
  const double stays = job.tiles.tiles.size() > 1
                           ? std::min(kProgramBytes + held, static_cast<double>(job.memory.resident_bytes))
                           : static_cast<double>(resident_with_grids()) -
                                 kSurveyReused * static_cast<double>(job.survey.counts.memory_bytes());
  const double peak =
      stays + threads + static_cast<double>(job.memory_request.kept_bytes) + std::max(tiles_bytes, gather);
  return std::max(peak, kOfPeakSoFar * static_cast<double>(peak_resident_bytes()));
}

std::uint64_t likely_temp_bytes(const TileJob& job, const TileNeeds& needs) {
  const auto points = static_cast<double>(job.survey.points());
  if (points == 0.0) return needs.further_temp_bytes;
  const double stored = points * (1.0 + (job.tiles.duplication - 1.0) * needs.halo_fill);
  const double bytes = needs.whole_halo ? likely_followed_bytes(job, needs, points, stored)
                                        : likely_waiting_bytes(job, needs, points, stored);
  return needs.further_temp_bytes + static_cast<std::uint64_t>(bytes);
}

}  // namespace arris::pipeline
