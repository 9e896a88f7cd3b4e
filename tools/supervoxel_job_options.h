#pragma once
/// @file Options of the verbs that run or plan the job of supervoxels.

#include <string>

#include "pipeline/supervoxel.h"
#include "run_options.h"
#include "supervoxel_options.h"

namespace CLI {
class App;
}

namespace arris::tools {

/// As typed; to_request() turns it into a checked request without outputs.
struct SupervoxelJobOptions {
  RunOptions run;
  SupervoxelOptions supervoxel;
  std::string spacing;
};

void add_supervoxel_job_options(CLI::App& verb, SupervoxelJobOptions& options);
pipeline::SupervoxelRequest to_request(SupervoxelJobOptions& options);

}  // namespace arris::tools
