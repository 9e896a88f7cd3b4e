#pragma once
/// @file What a run did, in numbers.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "features/contour/contour_method.h"
#include "pipeline/tiled_report.h"

namespace arris::pipeline {

struct ExtractReport : TiledReport {
  ContourParameters parameters;  ///< As used: everything resolved.

  // points_in = points_out + not_contour + all dropped ones (without keep_all).
  std::uint64_t not_contour = 0;
  std::uint64_t boundary = 0;
  std::uint64_t weak_boundary = 0;
  std::uint64_t fold = 0;
  std::uint64_t contact = 0;
  std::uint64_t voxels = 0;  ///< Method zheng, as the supervoxels.
  std::uint64_t supervoxels = 0;
  std::uint64_t voxel_tiles = 0;
};

nlohmann::ordered_json to_json(const ExtractReport& report);

}  // namespace arris::pipeline
