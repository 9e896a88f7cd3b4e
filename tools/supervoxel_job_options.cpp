#include "supervoxel_job_options.h"

#include <CLI/CLI.hpp>

namespace arris::tools {

void add_supervoxel_job_options(CLI::App& verb, SupervoxelJobOptions& options) {
  add_run_options(verb, options.run);
  verb.add_option("--spacing", options.spacing, "Point spacing (length; default: estimated)");
  add_supervoxel_options(verb, options.supervoxel, "Supervoxels");
}

pipeline::SupervoxelRequest to_request(SupervoxelJobOptions& options) {
  pipeline::SupervoxelRequest request;
  fill_run_request(options.run, request);
  request.parameters = to_parameters(options.supervoxel);
  request.spacing = length_or(options.spacing, 0.0);
  return request;
}

}  // namespace arris::tools
