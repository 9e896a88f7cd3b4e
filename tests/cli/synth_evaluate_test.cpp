/// @file Scenes and their truth through the real program: what a scan shows, and tolerances that follow its spacing.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/arris_process.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

/// Scans whose truth takes a fifth of the time of the default town's.
std::vector<std::string> small_town(const std::string& points, const std::string& scan, const std::string& truth) {
  return {"synth",    "town", "--set", "stations=2", "--set",   "windows=0",
          "--points", points, "-o",    scan,         "--truth", truth};
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(SynthTown_Truth, OfTheScan_IsTheDefaultAndTheSameForAnyThreads) {
  const TempFolder folder;
  std::vector<std::string> truths;
  for (const std::string threads : {"1", "3"}) {
    const std::string truth = folder / ("truth" + threads + ".csv").c_str();
    std::vector<std::string> arguments = small_town("20000", folder / ("scan" + threads + ".las").c_str(), truth);
    arguments.insert(arguments.end(), {"--threads", threads});
    ASSERT_EQ(run_arris(arguments).exit_code, 0);
    truths.push_back(text_of(truth));
  }
  EXPECT_EQ(truths[0], truths[1]);
  EXPECT_NE(truths[0].find("# truth_of=scan\n"), std::string::npos);
  EXPECT_NE(truths[0].find(",spacing,spacing_max\n"), std::string::npos);
  EXPECT_NE(truths[0].find("boundary,occlusion,segment,0,"), std::string::npos);
  std::vector<std::string> arguments = small_town("20000", folder / "model.las", folder / "model.csv");
  arguments.insert(arguments.end(), {"--truth-of", "model"});
  ASSERT_EQ(run_arris(arguments).exit_code, 0);
  const std::string model = text_of(folder / "model.csv");
  EXPECT_EQ(model.find("occlusion"), std::string::npos);
  EXPECT_EQ(model.find("spacing_max"), std::string::npos);
}

TEST(EvaluateLocalSpacing, InputAsPrediction_CoversTheTruthOfItsScan) {
  const TempFolder folder;
  const std::string scan = folder / "scan.las", truth = folder / "truth.csv";
  ASSERT_EQ(run_arris(small_town("50000", scan, truth)).exit_code, 0);
  const ProcessResult run =
      run_arris({"evaluate", scan, "--truth", truth, "--input", scan, "--local-spacing=max", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["spacing_of"], "local_max");
  for (const auto& row : json["tolerances"]) {
    EXPECT_NEAR(row["recall"].get<double>(), row["ceiling"].get<double>(), 1e-9);
    const bool two = row["tolerance_spacings"] == 2.0;
    EXPECT_GT(row["recall"], two ? 0.995 : 0.0);
  }
  // Every point is called a contour point, so those that should be are all right.
  EXPECT_EQ(json["labels"]["false_negatives"], 0);
  EXPECT_GT(json["labels"]["true_positives"], 0);
  const ProcessResult csv = run_arris({"evaluate", scan, "--truth", truth, "--local-spacing", "--csv"});
  EXPECT_EQ(csv.exit_code, 0);
  EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 5);
}

TEST(EvaluateOptions, ThatTheFilesCannotServe_ExitWith2) {
  const TempFolder folder;
  const std::string cloud = folder / "plane.las", truth = folder / "truth.csv";
  ASSERT_EQ(run_arris({"synth", "plane", "--points", "1000", "-o", cloud, "--truth", truth}).exit_code, 0);
  const std::vector<std::vector<std::string>> wrong{
      {"--local-spacing"}, {"--local-spacing=median"}, {"--min-score", "0.5"}, {"--json", "--csv"}};
  for (const auto& options : wrong) {
    std::vector<std::string> arguments{"evaluate", cloud, "--truth", truth};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProcessResult run = run_arris(arguments);
    EXPECT_EQ(run.exit_code, 2) << options.front();
    EXPECT_NE(run.err, "");
  }
}

}  // namespace
}  // namespace arris::test
