#include "adversarial_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/arris_process.h"
#include "support/las_tools.h"

namespace arris::test {
namespace {

constexpr std::uint64_t kMiB = 1024 * 1024;

/// Of a LAS file, from its header alone.
std::uint64_t las_points(const std::filesystem::path& path) {
  std::array<char, 255> header{};
  std::ifstream(path, std::ios::binary).read(header.data(), header.size());
  std::uint32_t legacy = 0;
  std::uint64_t points = 0;
  std::memcpy(&legacy, header.data() + 107, sizeof legacy);
  std::memcpy(&points, header.data() + 247, sizeof points);
  return header[25] >= 4 ? points : legacy;
}

bool is_one_line(const std::string& text) {
  return std::ranges::count(text, '\n') == 1 && text.ends_with('\n');
}

/// "... at least --memory 123MiB" or "... needs at least 123MiB"; 0 if there is none.
std::uint64_t least_budget_mib(const std::string& message) {
  const std::size_t unit = message.find("MiB", std::max<std::size_t>(message.find("at least "), 1) - 1);
  if (message.find("at least ") == std::string::npos || unit == std::string::npos) return 0;
  const std::size_t number = message.find_last_not_of("0123456789", unit - 1) + 1;
  return number < unit ? std::stoull(message.substr(number, unit - number)) : 0;
}

}  // namespace

const std::vector<AdversarialCommand>& adversarial_commands() {
  static const std::vector<AdversarialCommand> commands{{"arris", {"extract", "--keep-all"}},
                                                        {"liu", {"extract", "--keep-all", "--method", "liu"}},
                                                        {"zheng", {"extract", "--keep-all", "--method", "zheng"}},
                                                        {"supervoxel", {"supervoxel"}},
                                                        {"segment", {"segment"}}};
  return commands;
}

bool run_within_budget(const std::vector<std::filesystem::path>& inputs, const AdversarialCommand& command,
                       const AdversarialRun& run, std::uint64_t points, const std::filesystem::path& output) {
  const std::filesystem::path report_path = output.string() + ".json";
  std::uint64_t budget_mib = run.budget_mib;
  const auto start = [&] {
    std::vector<std::string> arguments = command.arguments;
    arguments.insert(arguments.end(), inputs.begin(), inputs.end());
    arguments.insert(arguments.end(), {"-o", output, "--overwrite", "-q", "--report", report_path, "--memory",
                                       std::to_string(budget_mib) + "MiB", "--threads", std::to_string(run.threads),
                                       "--tile-points", run.tile_points, "--temp-dir", output.parent_path()});
    return run_arris(arguments);
  };
  ProcessResult result = start();
  if (result.exit_code == 3) {
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_LE(result.peak_resident_bytes, budget_mib * kMiB) << "refused too late";
    const std::uint64_t least = least_budget_mib(result.err);
    EXPECT_GT(least, budget_mib) << result.err;
    if (least <= budget_mib) return false;
    budget_mib = least;
    result = start();
  }
  if (result.exit_code == 2) {
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    return false;
  }
  EXPECT_EQ(result.exit_code, 0) << result.err;
  if (result.exit_code != 0) return false;
  EXPECT_LE(result.peak_resident_bytes, budget_mib * kMiB);
  const auto report = nlohmann::json::parse(file_bytes(report_path));
  EXPECT_LE(report["memory"]["measured_peak_bytes"].get<std::uint64_t>(), budget_mib * kMiB);
  EXPECT_EQ(report["points"]["in"], points);
  EXPECT_EQ(las_points(output), points);
  return true;
}

}  // namespace arris::test
