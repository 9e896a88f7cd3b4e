/// @file --table and --adjacency against what a naive reader computes from the labelled points.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "supervoxel_runs.h"
#include "support/coloured_scan.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

constexpr double kStep = 0.001;
constexpr int kVoxelSteps = 15;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Supervoxels of a scan with voxels of 15 mm.
struct Labelled {
  LasView view;
  std::vector<std::uint32_t> labels;
  std::vector<std::vector<std::string>> table;
  std::set<Pair> adjacency;
};

void expect_json_to_be_the_csv(const TempFolder& folder, const Labelled& made) {
  const auto table = nlohmann::json::parse(file_bytes(folder / "t.json"));
  ASSERT_EQ(table.size() + 1, made.table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (std::size_t c = 0; c < made.table[0].size(); ++c)
      ASSERT_EQ(table[i][made.table[0][c]].get<double>(), std::stod(made.table[i + 1][c])) << made.table[0][c];
  }
  const auto pairs = nlohmann::json::parse(file_bytes(folder / "a.json"));
  ASSERT_EQ(pairs.size(), made.adjacency.size());
  for (const auto& pair : pairs) EXPECT_TRUE(made.adjacency.contains({pair[0], pair[1]}));
}

Labelled labelled(const TempFolder& folder, std::vector<std::string> options = {}) {
  options.insert(options.end(), {"--voxel", "15mm", "--seed", "120mm"});
  for (const char* end : {".csv", ".json"}) {
    std::vector<std::string> with = options;
    with.insert(with.end(), {"--table", folder.path() / (std::string("t") + end), "--adjacency",
                             folder.path() / (std::string("a") + end)});
    label(folder / "in.las", folder / "out.las", with);
  }
  Labelled made{view_las(folder / "out.las"), {}, csv_of(folder / "t.csv"), {}};
  made.labels = labels_of(made.view);
  const auto pairs = csv_of(folder / "a.csv");
  EXPECT_EQ(pairs[0], (std::vector<std::string>{"a", "b"}));
  Pair last{0, 0};
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const Pair pair{std::stoul(pairs[i][0]), std::stoul(pairs[i][1])};
    EXPECT_LT(last, pair) << "ascending, once each";
    EXPECT_LT(pair.first, pair.second);
    last = pair;
    made.adjacency.insert(pair);
  }
  expect_json_to_be_the_csv(folder, made);
  return made;
}

void expect_row(const std::vector<std::string>& row, std::uint32_t id, const std::vector<Eigen::Vector3d>& members) {
  ASSERT_EQ(row.size(), 10U);
  EXPECT_EQ(row[0], std::to_string(id));
  EXPECT_EQ(row[1], std::to_string(members.size()));
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : members) mean += p / static_cast<double>(members.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : members) covariance += (p - mean) * (p - mean).transpose() / static_cast<double>(members.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d normal(std::stod(row[5]), std::stod(row[6]), std::stod(row[7]));
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(std::stod(row[2 + axis]), mean[static_cast<Eigen::Index>(axis)], 0.0001);
  const Eigen::Vector3d values = solver.eigenvalues().cwiseMax(0.0);
  if (members.size() < 3 || values[1] <= 1e-6 * values[2]) {
    EXPECT_EQ(normal.norm(), 0.0) << id;
    return;
  }
  EXPECT_NEAR(normal.norm(), 1.0, 1e-5);
  EXPECT_NEAR(std::sqrt(std::max(0.0, normal.dot(covariance * normal))), std::sqrt(values[0]), 1e-5) << "its plane";
  EXPECT_NEAR(std::stod(row[9]), std::sqrt(values[0]), 1e-6);
  const double area = 4.0 * 3.14159265358979323846 * std::sqrt(values[1] * values[2]);
  EXPECT_NEAR(std::stod(row[8]), area, 1e-4 * area);
}

void expect_table(const Labelled& made) {
  std::map<std::uint32_t, std::vector<Eigen::Vector3d>> members;
  for (std::size_t i = 0; i < made.labels.size(); ++i) {
    const auto p = made.view.position(i);
    members[made.labels[i]].push_back(kStep * Eigen::Vector3d(p[0], p[1], p[2]));
  }
  EXPECT_EQ(made.table[0],
            (std::vector<std::string>{"id", "points", "x", "y", "z", "nx", "ny", "nz", "area", "thickness"}));
  ASSERT_EQ(made.table.size(), members.size() + 1);
  for (const auto& [id, points] : members) expect_row(made.table[id], id, points);
}

/// Pairs of labels in neighbouring voxels.
std::set<Pair> touching(const Labelled& made) {
  std::map<std::array<int, 3>, std::set<std::uint32_t>> voxels;
  for (std::size_t i = 0; i < made.labels.size(); ++i) {
    std::array<int, 3> key;
    for (std::size_t axis = 0; axis < 3; ++axis)
      key[axis] = static_cast<int>(std::floor((made.view.position(i)[axis] + kVoxelSteps / 2) / double{kVoxelSteps}));
    voxels[key].insert(made.labels[i]);
  }
  std::set<Pair> pairs;
  for (const auto& [key, labels] : voxels) {
    for (int i = 0; i < 27; ++i) {
      const auto found = voxels.find({key[0] + i / 9 - 1, key[1] + i / 3 % 3 - 1, key[2] + i % 3 - 1});
      if (found == voxels.end()) continue;
      for (const std::uint32_t a : labels) {
        for (const std::uint32_t b : found->second) {
          if (a < b) pairs.insert({a, b});
        }
      }
    }
  }
  return pairs;
}

// On one plane no point leaves the supervoxel of its voxel, so the points show which voxels touch.
TEST(SupervoxelTable, Plate_TableAndAdjacencyAreThoseOfThePoints) {
  const TempFolder folder;
  write_las(folder / "in.las", noisy_plate(120, 10));
  const Labelled made = labelled(folder);
  EXPECT_GT(expect_dense(made.labels), 60U);
  expect_table(made);
  EXPECT_EQ(made.adjacency, touching(made));
}

TEST(SupervoxelTable, Room_TableIsThatOfThePointsAndAdjacencyNearlyToo) {
  for (const char* features : {"normal", "fpfh"}) {
    const TempFolder folder;
    write_coloured_las(folder / "in.las", coloured_room(60, 65535));
    const Labelled made = labelled(folder, {"--features", features});
    expect_table(made);
    // Points beside folds may have moved on from the supervoxel of their voxel.
    const std::set<Pair> seen = touching(made);
    std::size_t both = 0;
    for (const Pair& pair : made.adjacency) both += seen.contains(pair);
    EXPECT_GT(both, made.adjacency.size() * 9 / 10);
    EXPECT_GT(both, seen.size() * 9 / 10);
  }
}

}  // namespace
}  // namespace arris::test
