#pragma once
/// @file The job of `arris supervoxel`: every point of a scan gets the id of its supervoxel.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "pipeline/run_report.h"
#include "pipeline/run_request.h"

namespace arris::pipeline {

struct SupervoxelRequest : RunRequest {
  SupervoxelParameters parameters;
  double spacing = 0.0;             ///< Data units; 0: the survey's.
  std::filesystem::path table;      ///< .csv or .json: a line per supervoxel; empty: not wanted.
  std::filesystem::path adjacency;  ///< .csv or .json: a line per pair of neighbours; empty: not wanted.
};

struct SupervoxelReport : RunReport {
  SupervoxelParameters parameters;  ///< As used: everything resolved.
  bool colours = false;
  std::uint64_t voxels = 0;
  std::uint64_t supervoxels = 0;
  std::uint64_t coarse = 0;  ///< Of them, those on coarser voxels, where points are far apart.
  std::uint64_t groups = 0;  ///< Of them, those that grew from no seed.
  std::uint64_t neighbour_pairs = 0;
  std::uint64_t tiles = 0;
  std::uint64_t largest_tile_voxels = 0;
};

/// Survey, voxels, supervoxels, then the inputs again with the column SupervoxelId (0: the point took no part). All
/// points are written. The bytes of the outputs depend on the input points and the parameters only. Outputs appear
/// whole or not at all; temporary files are gone when this returns or throws. Throws the errors of core/error.h.
SupervoxelReport label_supervoxels(const SupervoxelRequest& request, ProgressSink& progress, const CancelToken& cancel);

/// Survey only: parameters, and the voxels, memory and temporary files that are likely (without colours; real files
/// whose neighbours in space are neighbours in the file). Outputs of the request are not looked at.
SupervoxelReport plan_supervoxels(const SupervoxelRequest& request, ProgressSink& progress, const CancelToken& cancel);

nlohmann::ordered_json to_json(const SupervoxelReport& report);
nlohmann::ordered_json supervoxel_json(const SupervoxelParameters& parameters);

}  // namespace arris::pipeline
