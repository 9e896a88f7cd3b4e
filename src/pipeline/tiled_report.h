#pragma once
/// @file What every job over tiles of points tells about itself.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/run_report.h"
#include "pipeline/tile_job.h"

namespace arris::pipeline {

struct TiledReport : RunReport {
  std::uint64_t tiles = 0;
  std::uint64_t largest_tile_points = 0;
  std::uint64_t tile_points_limit = 0;
  int tile_workers = 1;
  double least_halo = 0.0;  ///< Data units.
  double widest_halo = 0.0;
  double duplication = 1.0;           ///< Stored points per point of the scan.
  std::uint64_t isolated = 0;         ///< Points with too few neighbours.
  std::uint64_t widened_queries = 0;  ///< Answered with a wider view than their tile's.
};

/// Copies what a plan decided.
void describe_tiles(const TileJob& job, TiledReport& report);
/// {"count": ..., "halo": ..., ...}
nlohmann::ordered_json tiles_json(const TiledReport& report);

}  // namespace arris::pipeline
