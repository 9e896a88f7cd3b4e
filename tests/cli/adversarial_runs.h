#pragma once
/// @file Every command on an adversarial shape: within the budget, or refused with a budget that does.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace arris::test {

struct AdversarialCommand {
  std::string name;
  std::vector<std::string> arguments;  ///< The verb and its options; inputs and outputs are added.
};

/// extract with each method, supervoxel, segment.
const std::vector<AdversarialCommand>& adversarial_commands();

struct AdversarialRun {
  std::uint64_t budget_mib = 256;
  int threads = 2;
  std::string tile_points = "none";
};

/// Runs a command and writes `output`. If it is refused, that must be one line with the least budget, with which it is
/// then run. Expects exit code 0, silence, and a peak, as the report and the system tell it, within the budget; as many
/// points in the output as in the input. Cases that parameters rule out (exit code 2, one line) write nothing.
/// @return  whether there is an output.
bool run_within_budget(const std::vector<std::filesystem::path>& inputs, const AdversarialCommand& command,
                       const AdversarialRun& run, std::uint64_t points, const std::filesystem::path& output);

}  // namespace arris::test
