/// @file The accuracy that the documentation promises of `extract --method liu` with defaults, on scenes with exact
/// truth.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "support/arris_process.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

/// F1 at a tolerance of one spacing.
double f1(const std::vector<std::string>& synth, const std::vector<std::string>& evaluate) {
  const TempFolder folder;
  std::vector<std::string> arguments{"synth"};
  arguments.insert(arguments.end(), synth.begin(), synth.end());
  arguments.insert(arguments.end(), {"-o", folder / "scan.las", "--truth", folder / "truth.csv"});
  const ProcessResult made = run_arris(arguments);
  if (made.exit_code != 0) throw std::runtime_error(made.err);
  const ProcessResult run = run_arris({"extract", folder / "scan.las", "-o", folder / "edges.las"});
  if (run.exit_code != 0) throw std::runtime_error(run.err);
  arguments = {"evaluate", folder / "edges.las", "--truth", folder / "truth.csv", "--json"};
  arguments.insert(arguments.end(), evaluate.begin(), evaluate.end());
  const ProcessResult judged = run_arris(arguments);
  if (judged.exit_code != 0) throw std::runtime_error(judged.err);
  const auto result = nlohmann::json::parse(judged.out);
  for (const auto& row : result["tolerances"]) {
    if (std::abs(row["tolerance_spacings"].get<double>() - 1.0) < 1e-9) return row["f1"].get<double>();
  }
  throw std::runtime_error("no row for a tolerance of one spacing");
}

double block_f1(const char* noise) {
  return f1({"block", "--spacing", "0.25", "--sampling", "jittered", "--noise", noise, "--seed", "11"},
            {"--edges", "folds", "--classes", "fold"});
}

double plates_f1(const char* noise) {
  return f1({"plates", "--spacing", "0.25", "--sampling", "grid", "--noise", noise, "--seed", "11"},
            {"--edges", "boundaries", "--classes", "boundary"});
}

TEST(Accuracy, BlockFolds_NoNoise) {
  EXPECT_GE(block_f1("0"), 0.95);
}
TEST(Accuracy, BlockFolds_NoiseOfAFifthOfTheSpacing) {
  EXPECT_GE(block_f1("0.05"), 0.88);
}
TEST(Accuracy, PlatesBoundary_NoNoise) {
  EXPECT_GE(plates_f1("0"), 0.97);
}
TEST(Accuracy, PlatesBoundary_NoiseOfAFifthOfTheSpacing) {
  EXPECT_GE(plates_f1("0.05"), 0.90);
}

}  // namespace
}  // namespace arris::test
