/// @file What users of `arris supervoxel` rely on: every point labelled, records kept, defined results at the edges.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "corpus/strip.h"
#include "io/ply_view.h"
#include "supervoxel_runs.h"
#include "support/coloured_scan.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

const std::vector<AddedColumn> kColumn{{"SupervoxelId", 4}};

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

TEST(Supervoxel, Las_EveryPointIsLabelledAndWithoutOurColumnTheOutputIsTheInput) {
  const TempFolder folder;
  write_coloured_las(folder / "in.las", coloured_room(60, 65535));
  for (const char* features : {"normal", "fpfh"}) {
    label(folder / "in.las", folder / "out.las",
          {"--features", features, "--report", folder / "report.json", "--temp-dir", folder.path()});
    const std::string out = file_bytes(folder / "out.las");
    const std::vector<std::uint32_t> labels = labels_of(view_las(folder / "out.las"));
    const std::uint32_t count = expect_dense(labels);
    EXPECT_GT(count, 40U);
    EXPECT_LT(count, labels.size() / 20);
    EXPECT_EQ(differing_fields(strip_las(out, kColumn), file_bytes(folder / "in.las")), std::set<std::string>{});
    const auto report = nlohmann::json::parse(file_bytes(folder / "report.json"));
    EXPECT_EQ(report["supervoxels"]["count"], count);
    EXPECT_EQ(report["points"]["in"], labels.size());
    EXPECT_EQ(report["points"]["out"], labels.size());
    EXPECT_EQ(report["parameters"]["features"], features);
    EXPECT_EQ(report["colour"], true);
    EXPECT_LE(report["memory"]["measured_peak_bytes"].get<std::uint64_t>(),
              report["memory"]["budget_bytes"].get<std::uint64_t>());
    EXPECT_EQ(entries(folder.path()), 3U) << "temporary files stayed behind";
  }
}

TEST(Supervoxel, Ply_EveryPointIsLabelledAndWithoutOurColumnTheOutputIsTheInput) {
  const TempFolder folder;
  write_coloured_ply(folder / "in.ply", coloured_room(50, 255), "uchar");
  label(folder / "in.ply", folder / "out.ply");
  const std::string out = file_bytes(folder / "out.ply");
  const PlyView view = view_ply(out);
  ASSERT_EQ(view.types.at("SupervoxelId"), "uint");
  std::vector<std::uint32_t> labels;
  for (const auto& vertex : view.vertices) labels.push_back(static_cast<std::uint32_t>(vertex.at("SupervoxelId")));
  EXPECT_GT(expect_dense(labels), 40U);
  const PlyParts input = split_ply(file_bytes(folder / "in.ply"));
  const PlyParts stripped = strip_ply(out, kColumn);
  EXPECT_EQ(stripped.header, input.header);
  EXPECT_TRUE(stripped.body == input.body);
}

// 1 mm is the lattice of both: the same points are the same supervoxels, whatever the format.
TEST(Supervoxel, LasAndPlyOfTheSamePoints_GiveTheSameIdsInBothFormats) {
  const TempFolder folder;
  const auto points = coloured_room(40, 255);
  write_coloured_las(folder / "in.las", points);
  write_coloured_ply(folder / "in.ply", points, "uchar");
  std::vector<std::string> options{"--lattice", "0.001", "-o", folder / "both.ply"};
  label(folder / "in.las", folder / "a.las", options);
  const std::string from_las = file_bytes(folder / "both.ply");
  label(folder / "in.ply", folder / "b.las", options);
  const std::vector<std::uint32_t> ids = labels_of(view_las(folder / "a.las"));
  EXPECT_EQ(labels_of(view_las(folder / "b.las")), ids);
  for (const std::string& ply : {from_las, file_bytes(folder / "both.ply")}) {
    std::vector<std::uint32_t> labels;
    for (const auto& vertex : view_ply(ply).vertices)
      labels.push_back(static_cast<std::uint32_t>(vertex.at("SupervoxelId")));
    EXPECT_EQ(labels, ids);
  }
}

TEST(Supervoxel, FolderOfFiles_IsOneScan) {
  const TempFolder folder;
  write_coloured_las(folder / "in.las", coloured_room(40, 65535));
  std::filesystem::create_directory(folder / "scans");
  split_las(folder / "in.las", 4, folder / "scans");
  label(folder / "in.las", folder / "whole.las");
  label(folder / "scans", folder / "parts.las");
  EXPECT_EQ(labels_of(view_las(folder / "parts.las")), labels_of(view_las(folder / "whole.las")));
}

TEST(Supervoxel, Colour_TellsSurfacesApartThatAreFlat) {
  // One plane, half white and half black, the border in the middle of voxels' and cells' ways.
  std::vector<ColouredPoint> points;
  for (std::int32_t i = 0; i < 120; ++i) {
    for (std::int32_t j = 0; j < 120; ++j) {
      const double channel = i < 53 ? 255.0 : 1.0;
      points.push_back({{10 * i, 10 * j, 0}, {channel, channel, channel}});
    }
  }
  const TempFolder folder;
  write_coloured_las(folder / "in.las", points);
  const auto mixed = [&](const std::vector<std::string>& options) {
    label(folder / "in.las", folder / "out.las", options);
    const std::vector<std::uint32_t> labels = labels_of(view_las(folder / "out.las"));
    std::map<std::uint32_t, std::set<bool>> colours;
    for (std::size_t i = 0; i < labels.size(); ++i) colours[labels[i]].insert(points[i].colour[0] > 100.0);
    return std::count_if(colours.begin(), colours.end(), [](const auto& of) { return of.second.size() > 1; });
  };
  const std::vector<std::string> strong{"--colour-weight", "2", "--voxel", "0.01", "--seed", "0.1"};
  std::vector<std::string> off = strong;
  off.insert(off.end(), {"--colour", "off"});
  EXPECT_EQ(mixed(strong), 0);
  EXPECT_GT(mixed(off), 5);
}

TEST(Supervoxel, PointsWithoutPosition_Get0AndStayInTheOutput) {
  const TempFolder folder;
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 903\nproperty double x\nproperty double y\nproperty double "
      "z\nend_header\nnan 1 2\n";
  for (int i = 0; i < 900; ++i) ply += std::to_string(i % 30) + " " + std::to_string(i / 30) + " 0\n";
  ply += "1 nan 2\n1 2 inf\n";
  write_bytes(folder / "in.ply", ply);
  const ProcessResult run = run_arris({"supervoxel", folder / "in.ply", "-o", folder / "out.ply"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("3 points have NaN or infinite coordinates"), std::string::npos) << run.err;
  const std::string out = file_bytes(folder / "out.ply");
  EXPECT_EQ(strip_ply(out, kColumn).tokens, split_ply(ply).tokens);
  const std::vector<std::string> tokens = split_ply(out).tokens;
  ASSERT_EQ(tokens.size(), 4U * 903);
  std::vector<std::uint32_t> labels;
  for (std::size_t i = 3; i < tokens.size(); i += 4)
    labels.push_back(static_cast<std::uint32_t>(std::stoul(tokens[i])));
  EXPECT_EQ(labels[0], 0U);
  EXPECT_EQ(labels[901], 0U);
  EXPECT_EQ(labels[902], 0U);
  expect_dense(labels, 3);
}

TEST(Supervoxel, ExcludedPoints_Get0AndChangeNothingForTheOthers) {
  const TempFolder folder;
  auto points = noisy_plate(60, 10);
  write_las(folder / "plain.las", points);
  for (std::int32_t i = 0; i < 500; ++i) points.push_back({i, i, 30 + i % 9});
  write_las(folder / "noise.las", points);
  LasView view = view_las(folder / "noise.las");
  for (std::uint64_t i = 3600; i < view.points; ++i) view.bytes[view.offset_to_points + i * view.record_bytes + 15] = 7;
  write_bytes(folder / "noise.las", view.bytes);
  label(folder / "plain.las", folder / "a.las");
  const std::vector<std::uint32_t> plain = labels_of(view_las(folder / "a.las"));
  label(folder / "noise.las", folder / "b.las", {"--exclude-class", "7,18"});
  std::vector<std::uint32_t> labels = labels_of(view_las(folder / "b.las"));
  ASSERT_EQ(labels.size(), 4100U);
  expect_dense(labels, 500);
  labels.resize(3600);
  EXPECT_EQ(labels, plain);
}

struct Outcome {
  std::vector<std::uint32_t> labels;
  std::vector<std::vector<std::string>> table;
  std::vector<std::vector<std::string>> adjacency;
};
Outcome outcome_of(const std::vector<std::array<std::int32_t, 3>>& points) {
  const TempFolder folder;
  write_las(folder / "in.las", points);
  label(folder / "in.las", folder / "out.las", {"--table", folder / "t.csv", "--adjacency", folder / "a.csv"});
  label(folder / "in.las", folder / "out.las", {"--table", folder / "t.json", "--adjacency", folder / "a.json"});
  const auto table = csv_of(folder / "t.csv");
  EXPECT_EQ(nlohmann::json::parse(file_bytes(folder / "t.json")).size() + 1, table.size());
  const auto adjacency = csv_of(folder / "a.csv");
  EXPECT_EQ(nlohmann::json::parse(file_bytes(folder / "a.json")).size() + 1, adjacency.size());
  return {labels_of(view_las(folder / "out.las")), table, adjacency};
}

TEST(Supervoxel, NoPoints_GiveAnEmptyScanAndEmptyTables) {
  const Outcome outcome = outcome_of({});
  EXPECT_TRUE(outcome.labels.empty());
  EXPECT_EQ(outcome.table.size(), 1U) << "the header";
  EXPECT_EQ(outcome.adjacency.size(), 1U);
}

TEST(Supervoxel, OnePoint_IsOneSupervoxel) {
  const Outcome outcome = outcome_of({{500, -700, 900}});
  EXPECT_EQ(outcome.labels, (std::vector<std::uint32_t>{1}));
  ASSERT_EQ(outcome.table.size(), 2U);
  EXPECT_EQ(outcome.table[1], (std::vector<std::string>{"1", "1", "0.5000", "-0.7000", "0.9000", "0.000000", "0.000000",
                                                        "0.000000", "0", "0"}));
}

TEST(Supervoxel, ManyPointsAtOnePlace_AreOneSupervoxel) {
  const Outcome outcome = outcome_of(std::vector<std::array<std::int32_t, 3>>(200'000, {1000, 2000, 3000}));
  EXPECT_EQ(outcome.labels, std::vector<std::uint32_t>(200'000, 1));
  ASSERT_EQ(outcome.table.size(), 2U);
  EXPECT_EQ(outcome.table[1][1], "200000");
  EXPECT_EQ(outcome.table[1][2], "1.0000");
}

TEST(Supervoxel, PointsOnALine_AreSupervoxelsWithoutNormal) {
  std::vector<std::array<std::int32_t, 3>> points;
  for (std::int32_t i = 0; i < 2000; ++i) points.push_back({10 * i, 0, -20 * i});
  const Outcome outcome = outcome_of(points);
  const std::uint32_t count = expect_dense(outcome.labels);
  EXPECT_GT(count, 20U);
  ASSERT_EQ(outcome.table.size(), count + 1U);
  for (std::size_t i = 1; i < outcome.table.size(); ++i) {
    EXPECT_EQ(outcome.table[i][5] + outcome.table[i][6] + outcome.table[i][7], "0.0000000.0000000.000000");
    EXPECT_EQ(outcome.table[i][8], "0");
  }
  EXPECT_EQ(outcome.adjacency.size(), count + 0U) << "a chain";
}

TEST(Supervoxel, CoordinatesAtTheEndsOfInt32_AreLabelled) {
  const Outcome outcome = outcome_of({{INT32_MIN, INT32_MIN, INT32_MIN}, {INT32_MAX, INT32_MAX, INT32_MAX}, {0, 0, 0}});
  expect_dense(outcome.labels);
}

}  // namespace
}  // namespace arris::test
