#pragma once
/// @file The main job: contour points of scans of any size, in a memory budget. This is the library's front door.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/contour_method.h"
#include "io/point_source.h"
#include "pipeline/extract_report.h"

namespace arris::pipeline {

struct ExtractRequest {
  std::vector<std::string> inputs;  ///< Files and folders.
  io::Tolerance tolerance = io::Tolerance::kUsual;
  io::PointExclusion exclusion;  ///< Points that take no part; with keep_all they are written all the same.
  std::vector<std::filesystem::path> outputs;  ///< The extension picks the format; at least one.
  ContourParameters method;                    ///< max_radius 0: resolved from the survey.
  std::uint64_t memory_bytes = 0;              ///< Bound on the resident memory of the whole process, > 0.
  int threads = 1;                             ///< >= 1.
  std::filesystem::path temp_dir;              ///< Existing folder for temporary files.
  std::uint64_t max_temp_bytes = 0;            ///< 0: what is free.
  std::uint64_t tile_points_cap = 0;           ///< For tests and tuning; 0: chosen.
  double lattice_step = 0.0;                   ///< 0: chosen (tiling/survey.h).
  bool overwrite = false;
  bool mixed_crs = false;    ///< Take inputs with different coordinate reference systems for one.
  bool keep_all = false;     ///< Write every point, not only contour points.
  bool refined = false;      ///< Add the columns EdgeX, EdgeY, EdgeZ (method arris).
  bool hash_inputs = false;  ///< Put content hashes into the report (reads the inputs once more).
};

/// Runs the job: survey, plan, partition, tiles, widening, gather and write (docs/architecture.md). The bytes of the
/// outputs depend on the input points and the parameters only. Outputs appear whole or not at all; temporary files are
/// gone when this returns or throws. Throws the errors of core/error.h.
ExtractReport extract(const ExtractRequest& request, ProgressSink& progress, const CancelToken& cancel);

/// Everything up to the plan: reads the inputs, writes nothing.
ExtractReport plan_only(const ExtractRequest& request, ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
