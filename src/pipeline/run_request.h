#pragma once
/// @file What every job that reads scans and writes points is asked.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/point_source.h"

namespace arris::pipeline {

struct RunRequest {
  std::vector<std::string> inputs;  ///< Files and folders.
  io::Tolerance tolerance = io::Tolerance::kUsual;
  io::PointExclusion exclusion;                ///< Points that take no part.
  std::vector<std::filesystem::path> outputs;  ///< The extension picks the format; at least one.
  std::uint64_t memory_bytes = 0;              ///< Bound on the resident memory of the whole process, > 0.
  int threads = 1;                             ///< >= 1.
  std::filesystem::path temp_dir;              ///< Existing folder for temporary files.
  std::uint64_t max_temp_bytes = 0;            ///< 0: what is free.
  std::uint64_t tile_points_cap = 0;           ///< For tests and tuning: most points (or voxels) of a core; 0: chosen.
  double lattice_step = 0.0;                   ///< 0: chosen (tiling/survey.h).
  bool overwrite = false;
  bool mixed_crs = false;    ///< Take inputs with different coordinate reference systems for one.
  bool hash_inputs = false;  ///< Put content hashes into the report (reads the inputs once more).
};

}  // namespace arris::pipeline
