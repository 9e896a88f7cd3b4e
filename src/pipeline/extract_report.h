#pragma once
/// @file What a run did, in numbers.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/lattice.h"
#include "features/contour_method.h"

namespace arris::pipeline {

struct InputReport {
  std::string path;
  std::string layout;
  std::uint64_t points = 0;
  std::uint64_t size_bytes = 0;
  std::string hash;  ///< XXH3-64 of the file, empty if not asked for.
};

struct WarningReport {
  std::string code;
  std::string text;
};

struct ExtractReport {
  ContourParameters parameters;  ///< As used: everything resolved.
  Lattice lattice;
  LatticeBox bounds;
  double spacing = 0.0;
  std::vector<InputReport> inputs;
  std::vector<std::string> outputs;
  std::vector<WarningReport> warnings;

  // points_in = points_out + not_contour + all dropped ones (without keep_all).
  std::uint64_t points_in = 0;
  std::uint64_t points_out = 0;
  std::uint64_t not_contour = 0;
  std::uint64_t dropped_nonfinite = 0;
  std::uint64_t dropped_out_of_range = 0;
  std::uint64_t dropped_excluded = 0;
  std::uint64_t boundary = 0;
  std::uint64_t weak_boundary = 0;
  std::uint64_t fold = 0;
  std::uint64_t isolated = 0;

  std::uint64_t tiles = 0;
  std::uint64_t largest_tile_points = 0;
  std::uint64_t tile_points_limit = 0;
  int tile_workers = 1;
  double least_halo = 0.0;  ///< Data units.
  double widest_halo = 0.0;
  double duplication = 1.0;
  std::uint64_t widened_queries = 0;

  int threads = 1;
  std::uint64_t memory_budget_bytes = 0;
  std::uint64_t predicted_peak_bytes = 0;
  std::uint64_t peak_resident_bytes = 0;
  std::uint64_t predicted_temp_bytes = 0;
  std::uint64_t peak_temp_bytes = 0;
  std::vector<std::pair<std::string, double>> seconds;  ///< Wall time per phase.
  double cpu_seconds = 0.0;
};

nlohmann::ordered_json to_json(const ExtractReport& report);

}  // namespace arris::pipeline
