#include "pipeline/tiled_report.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace arris::pipeline {

void describe_tiles(const TileJob& job, TiledReport& report) {
  report.tiles = job.tiles.tiles.size();
  report.largest_tile_points = job.tiles.largest_covered_points;
  report.tile_points_limit = job.memory.max_tile_points;
  report.tile_workers = job.memory.tile_workers;
  report.duplication = job.tiles.duplication;
  std::int64_t least = job.tiles.tiles.empty() ? 0 : std::numeric_limits<std::int64_t>::max();
  std::int64_t widest = 0;
  for (const tiling::PlannedTile& tile : job.tiles.tiles) {
    least = std::min(least, tile.core.min[0] - tile.covered.min[0]);
    widest = std::max(widest, tile.core.min[0] - tile.covered.min[0]);
  }
  report.least_halo = static_cast<double>(least) * job.survey.lattice.step;
  report.widest_halo = static_cast<double>(widest) * job.survey.lattice.step;
  report.predicted_peak_bytes = job.predicted_peak_bytes;
  report.predicted_temp_bytes = job.predicted_temp_bytes;
}

nlohmann::ordered_json tiles_json(const TiledReport& r) {
  return {{"count", r.tiles},
          {"largest_points", r.largest_tile_points},
          {"points_limit", r.tile_points_limit},
          {"in_flight", r.tile_workers},
          {"halo", {{"least", r.least_halo}, {"widest", r.widest_halo}}},
          {"duplication", r.duplication},
          {"widened_queries", r.widened_queries}};
}

}  // namespace arris::pipeline
