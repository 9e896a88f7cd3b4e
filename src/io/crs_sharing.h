#pragma once
/// @file Inputs of one output must agree on their coordinate reference system.

#include <string>
#include <vector>

#include "io/kept_writers.h"

namespace arris::io {

/// Throws ConfigError if two LAS inputs name different systems (WKT texts or GeoTIFF keys that differ), unless
/// job.options.mixed_crs; then, and where some inputs name none or WKT stands against GeoTIFF keys, adds a warning.
void check_crs_sharing(const KeptJob& job, std::vector<std::string>& warnings);

}  // namespace arris::io
