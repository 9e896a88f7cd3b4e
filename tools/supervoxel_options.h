#pragma once
/// @file Options of the supervoxel clustering, for the verb `supervoxel` and for `extract --method zheng`.

#include <string>

#include "features/supervoxel/supervoxel_parameters.h"

namespace CLI {
class App;
}

namespace arris::tools {

/// As typed.
struct SupervoxelOptions {
  SupervoxelParameters parameters;
  std::string voxel, seed;  // Lengths with units.
  std::string features = "normal";
  std::string colour = "auto";
};

/// @param group  under which the help lists them.
void add_supervoxel_options(CLI::App& verb, SupervoxelOptions& options, const std::string& group);
SupervoxelParameters to_parameters(const SupervoxelOptions& options);

}  // namespace arris::tools
