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

TEST(SynthLabels, AreAColumnMore_AndTheRestStaysTheSame) {
  const TempFolder folder;
  for (const std::string scene : {"block", "town"}) {
    const std::string plain = folder / "plain.ply", labelled = folder / "labelled.ply";
    ASSERT_EQ(run_arris({"synth", scene, "--points", "5000", "-o", plain, "--overwrite"}).exit_code, 0);
    ASSERT_EQ(run_arris({"synth", scene, "--points", "5000", "-o", labelled, "--labels", "--overwrite"}).exit_code, 0);
    EXPECT_EQ(text_of(plain).find("FaceId"), std::string::npos);
    EXPECT_NE(text_of(labelled).find("property uint FaceId\nend_header"), std::string::npos);
    // The truth is a perfect segmentation of itself, and the points of the other cloud are the same.
    const ProcessResult run = run_arris({"evaluate", labelled, "--labels", labelled, "--segments", "FaceId", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["achievable_accuracy"], 1.0);
    EXPECT_EQ(json["adjusted_rand"], 1.0);
    EXPECT_EQ(json["boundaries"][0]["recall"], 1.0);
    EXPECT_EQ(json["left_out"], 0);
    if (scene == "block") {
      EXPECT_EQ(json["segments"], 10);
    }
  }
}

TEST(EvaluateSegments, PlanesOfRoofs_AreJudgedWithTheirTrees) {
  const TempFolder folder;
  const std::string cloud = folder / "roofs.las";
  ASSERT_EQ(run_arris({"synth", "roofs", "--spacing", "0.7", "-o", cloud, "--labels"}).exit_code, 0);
  const std::vector<std::string> evaluate{"evaluate", cloud, "--labels", cloud, "--spacing", "0.7"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), evaluate.begin(), evaluate.end());
    return run_arris(more);
  };
  const ProcessResult truth = with({"--segments", "FaceId", "--planes", "--min-area", "20", "--json"});
  ASSERT_EQ(truth.exit_code, 0) << truth.err;
  const auto planes = nlohmann::json::parse(truth.out)["planes"];
  EXPECT_EQ(planes["min_area"], 20.0);
  EXPECT_EQ(planes["all"]["planes_found"], 33);
  EXPECT_LT(planes["large"]["planes"], 33);
  EXPECT_EQ(planes["large"]["correctness"], 1.0);
  EXPECT_EQ(planes["strays_unsegmented_share"], 1.0);
  // Numbers of faces are those of surfaces, but trees have one too.
  const ProcessResult faces = with({"--segments", "point_source_id", "--planes"});
  ASSERT_EQ(faces.exit_code, 0) << faces.err;
  EXPECT_NE(faces.out.find("points on no surface, 0.0000 without a segment"), std::string::npos) << faces.out;
  EXPECT_NE(faces.out.find("segments alone 7"), std::string::npos) << faces.out;
  EXPECT_EQ(with({"--segments", "FaceId"}).out.find("planes found"), std::string::npos);
  EXPECT_EQ(with({"--segments", "FaceId", "--min-area", "-1"}).exit_code, 2);
}

TEST(EvaluateSegments, OfFormatsScalesAndColumns_CompareThePointsThatAreTheSame) {
  const TempFolder folder;
  const std::string las = folder / "block.las", ply = folder / "block.ply";
  for (const std::string& cloud : {las, ply}) {
    ASSERT_EQ(
        run_arris({"synth", "block", "--points", "5000", "--outliers", "0.05", "-o", cloud, "--labels"}).exit_code, 0);
  }
  // The numbers of the faces that synth writes besides are a perfect segmentation of the block.
  const ProcessResult table =
      run_arris({"evaluate", ply, "--labels", las, "--segments", "point_source_id", "--radius", "1", "--voxel", "0.5"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_NE(table.out.find("on 10 surfaces"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("within 1 of another label"), std::string::npos) << table.out;
  const ProcessResult csv =
      run_arris({"evaluate", ply, "--labels", las, "--segments", "point_source_id", "--spacing", "0.6", "--csv"});
  EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 4);
  EXPECT_NE(csv.out.find("\n0.6,1,1,1,"), std::string::npos) << csv.out;
}

TEST(EvaluateSegments, OfOtherPointsOrWithoutLabels_SayWhatToDo) {
  const TempFolder folder;
  const std::string truth = folder / "truth.las", other = folder / "other.las", fewer = folder / "fewer.las";
  ASSERT_EQ(run_arris({"synth", "plane", "--points", "900", "-o", truth, "--labels"}).exit_code, 0);
  ASSERT_EQ(run_arris({"synth", "plane", "--points", "900", "--seed", "2", "-o", other, "--labels"}).exit_code, 0);
  ASSERT_EQ(run_arris({"synth", "plane", "--points", "400", "-o", fewer, "--labels"}).exit_code, 0);
  const auto complaint = [&](int exit_code, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "evaluate");
    const ProcessResult run = run_arris(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  EXPECT_NE(complaint(1, {other, "--labels", truth, "--segments", "FaceId"}).find("point 0 is at ("),
            std::string::npos);
  EXPECT_NE(complaint(1, {fewer, "--labels", truth, "--segments", "FaceId"}).find("have 400 and 900 points"),
            std::string::npos);
  EXPECT_NE(complaint(2, {truth, "--labels", truth}).find("no column SupervoxelId or SegmentId"), std::string::npos);
  EXPECT_NE(complaint(2, {truth, "--labels", truth, "--segments", "FaceId", "--faces", "Face"}).find("--faces"),
            std::string::npos);
  EXPECT_NE(complaint(2, {truth, "--labels", truth, "--segments", "FaceId", "--edges", "folds"}), "");
  EXPECT_NE(complaint(2, {truth, "--segments", "FaceId"}), "");
  EXPECT_NE(complaint(2, {truth}).find("--truth"), std::string::npos);
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
