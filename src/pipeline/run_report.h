#pragma once
/// @file What every job tells about itself, in numbers.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/lattice.h"

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

struct RunReport {
  Lattice lattice;
  LatticeBox bounds;
  double spacing = 0.0;
  std::vector<InputReport> inputs;
  std::vector<std::string> outputs;
  std::vector<WarningReport> warnings;

  std::uint64_t points_in = 0;
  std::uint64_t points_out = 0;
  std::uint64_t dropped_nonfinite = 0;
  std::uint64_t dropped_out_of_range = 0;
  std::uint64_t dropped_excluded = 0;

  int threads = 1;
  std::uint64_t memory_budget_bytes = 0;
  std::uint64_t predicted_peak_bytes = 0;
  std::uint64_t peak_resident_bytes = 0;
  std::uint64_t predicted_temp_bytes = 0;
  std::uint64_t peak_temp_bytes = 0;
  std::vector<std::pair<std::string, double>> seconds;  ///< Wall time per phase.
  double cpu_seconds = 0.0;
};

/// Schema, versions, lattice, spacing, inputs and outputs: how every report begins.
nlohmann::ordered_json report_head(const RunReport& report, const char* schema);
/// Threads, memory, disk, time and warnings: how every report ends.
void append_report_tail(nlohmann::ordered_json& json, const RunReport& report);
/// {"non_finite": ..., "out_of_range": ..., "excluded": ...}
nlohmann::ordered_json dropped_json(const RunReport& report);

}  // namespace arris::pipeline
