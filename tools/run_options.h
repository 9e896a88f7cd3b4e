#pragma once
/// @file Options of every verb that runs a job over scans.

#include <string>
#include <vector>

#include "common_options.h"
#include "pipeline/run_request.h"

namespace CLI {
class App;
}

namespace arris::tools {

/// As typed; fill_run_request() checks.
struct RunOptions {
  std::vector<std::string> inputs;
  std::string memory;
  int threads = 0;
  std::string temp_dir;
  std::string max_temp;
  std::string tile_points = "none";
  std::string lattice;
  ToleranceOptions tolerance;
  std::vector<std::string> exclude;
  std::vector<int> exclude_classes;
  std::vector<int> only_classes;
  DisplayOptions display;
  std::string memory_why;  ///< Filled in: where the budget came from.
};

void add_run_options(CLI::App& verb, RunOptions& options);
void fill_run_request(RunOptions& options, pipeline::RunRequest& request);

/// parse_length(), or `otherwise` if nothing was typed.
double length_or(const std::string& text, double otherwise);

}  // namespace arris::tools
