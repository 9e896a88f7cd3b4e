/// @file The accuracy that the documentation promises of `extract` with defaults, on scenes with exact truth. Bars lie
/// a little below what was measured (one seed).

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>

#include "support/arris_process.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

/// F1 at a tolerance of one spacing.
double f1(const std::string& method, const std::vector<std::string>& synth, const std::vector<std::string>& evaluate) {
  const TempFolder folder;
  std::vector<std::string> arguments{"synth"};
  arguments.insert(arguments.end(), synth.begin(), synth.end());
  arguments.insert(arguments.end(), {"--seed", "11", "-o", folder / "scan.las", "--truth", folder / "truth.csv"});
  const ProcessResult made = run_arris(arguments);
  if (made.exit_code != 0) throw std::runtime_error(made.err);
  const ProcessResult run =
      run_arris({"extract", folder / "scan.las", "-o", folder / "edges.las", "--method", method, "-q"});
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

struct Promise {
  const char* method;
  const char* sampling;
  const char* spacing;
  const char* noise;
  double least_f1;
};

void PrintTo(const Promise& p, std::ostream* out) {
  *out << p.method << ", " << p.sampling << ", spacing " << p.spacing << ", noise " << p.noise;
}

class BlockFolds : public ::testing::TestWithParam<Promise> {};

TEST_P(BlockFolds, Defaults_KeepThePromise) {
  const Promise& p = GetParam();
  EXPECT_GE(f1(p.method, {"block", "--spacing", p.spacing, "--sampling", p.sampling, "--noise", p.noise},
               {"--edges", "folds", "--classes", "fold"}),
            p.least_f1);
}

INSTANTIATE_TEST_SUITE_P(Liu, BlockFolds,
                         ::testing::Values(Promise{"liu", "jittered", "0.25", "0", 0.95},
                                           Promise{"liu", "jittered", "0.25", "0.05", 0.88}));
INSTANTIATE_TEST_SUITE_P(Arris, BlockFolds,
                         ::testing::Values(Promise{"arris", "jittered", "0.25", "0", 0.99},
                                           Promise{"arris", "jittered", "0.25", "0.05", 0.985},
                                           Promise{"arris", "jittered", "0.25", "0.1", 0.955},
                                           Promise{"arris", "jittered", "0.25", "0.2", 0.83},
                                           Promise{"arris", "random", "0.25", "0", 0.955},
                                           Promise{"arris", "random", "0.25", "0.05", 0.95},
                                           Promise{"arris", "random", "0.25", "0.1", 0.92},
                                           Promise{"arris", "random", "0.25", "0.2", 0.80}));

class PlatesBoundary : public ::testing::TestWithParam<Promise> {};

TEST_P(PlatesBoundary, Defaults_KeepThePromise) {
  const Promise& p = GetParam();
  EXPECT_GE(f1(p.method, {"plates", "--spacing", p.spacing, "--sampling", p.sampling, "--noise", p.noise},
               {"--edges", "boundaries", "--classes", "boundary"}),
            p.least_f1);
}

INSTANTIATE_TEST_SUITE_P(Liu, PlatesBoundary,
                         ::testing::Values(Promise{"liu", "grid", "0.25", "0", 0.97},
                                           Promise{"liu", "grid", "0.25", "0.05", 0.90}));
INSTANTIATE_TEST_SUITE_P(Arris, PlatesBoundary,
                         ::testing::Values(Promise{"arris", "jittered", "0.1", "0", 0.985},
                                           Promise{"arris", "jittered", "0.1", "0.02", 0.96},
                                           Promise{"arris", "random", "0.1", "0", 0.81},
                                           Promise{"arris", "random", "0.1", "0.02", 0.79},
                                           Promise{"arris", "grid", "0.25", "0", 0.98},
                                           Promise{"arris", "grid", "0.25", "0.05", 0.945}));

}  // namespace
}  // namespace arris::test
