#pragma once
/// @file Options of the verbs that run or plan a job.

#include <string>

#include "pipeline/extract.h"
#include "run_options.h"
#include "supervoxel_options.h"

namespace CLI {
class App;
}

namespace arris::tools {

/// As typed; to_request() turns it into a checked request.
struct JobOptions {
  RunOptions run;
  std::string method = "arris";
  LiuParameters liu;
  std::string span = "bracket";
  std::string emit = "emit";
  double precision = -1.0;
  bool thin = false;
  std::string viewpoint = "above";
  std::string radius, cf1, far_distance, spacing, max_radius, noise;  // Lengths with units.
  bool literal = false;
  bool neighbours_only = false;
  ZhengParameters zheng;
  std::string alpha_radius, contact_cap, seam_distance;  // Lengths with units.
  SupervoxelOptions supervoxel;
  bool no_boundary = false;
  bool no_fold = false;
};

void add_job_options(CLI::App& verb, JobOptions& options);
pipeline::ExtractRequest to_request(JobOptions& options, const CLI::App& verb);

}  // namespace arris::tools
