#pragma once
/// @file What a job over tiles will likely take, as reports foretell it: measured shares of what bounds it.

#include <cstdint>

#include "pipeline/tile_job.h"

namespace arris::pipeline {

/// Resident at the peak, of the tiles in flight with the scratch of all threads.
/// @param analyses  of them that are analysed at a time.
double likely_tiles_bytes(const TileJob& job, int analyses);
/// Resident at the peak, of the process. @param tiles_bytes  likely_tiles_bytes(), or more that takes their place.
double likely_peak_bytes(const TileJob& job, double tiles_bytes);
/// On disk at the peak.
std::uint64_t likely_temp_bytes(const TileJob& job, const TileNeeds& needs);

}  // namespace arris::pipeline
