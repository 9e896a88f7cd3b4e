#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tiling_matrix.h"

namespace arris::test {
namespace {

TEST(ExactTiling, PointsOnTileFaces_SameBytes) {
  const TempFolder folder;
  write_points_on_tile_faces(folder / "faces.las");
  expect_same_bytes(folder / "faces.las", small_matrix(), 20);
}

TEST(ExactTiling, SyntheticBlock_SameBytes) {
  const TempFolder folder;
  ASSERT_EQ(run_arris({"synth", "block", "--spacing", "0.25", "--noise", "0.05", "--seed", "3", "-o",
                       folder / "scan.las", "--truth", folder / "truth.csv"})
                .exit_code,
            0);
  expect_same_bytes(folder / "scan.las", small_matrix(), 10);
}

TEST(ExactTiling, SimulatedTown_SameBytes) {
  const TempFolder folder;
  ASSERT_EQ(run_arris({"synth", "town", "--points", "150000", "--noise", "2mm", "--seed", "4", "-o",
                       folder / "scan.las", "--truth", folder / "truth.csv"})
                .exit_code,
            0);
  expect_same_bytes(folder / "scan.las", small_matrix(), 10);
}

// A LAS file of another scale, a PLY and a LAS of the usual kind, with every third point excluded by its class.
TEST(ExactTiling, MixedLayoutsAndExclusions_SameBytes) {
  const TempFolder folder;
  const TempFolder scans;
  const auto synth = [&](const char* name, const char* seed, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "synth",      "block",   "--spacing",          "0.4",        "--noise", "0.05", "--seed", seed, "-o",
        scans / name, "--truth", folder / "truth.csv", "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(run_arris(arguments).exit_code, 0);
  };
  synth("a.las", "1", {});
  synth("b.ply", "2", {});
  std::vector<std::array<std::int32_t, 3>> points;
  for (std::int32_t x = -200; x < 200; ++x) {
    for (std::int32_t y = -200; y < 200; ++y) points.push_back({x * 7, y * 7, 900});
  }
  write_las(scans / "c.las", points, 0.01);
  LasView view = view_las(scans / "c.las");
  for (std::uint64_t i = 0; i < view.points; i += 3) view.bytes[view.offset_to_points + i * view.record_bytes + 15] = 7;
  write_bytes(scans / "c.las", view.bytes);
  expect_same_bytes(scans.path(), small_matrix(), 10, {"--exclude-class", "7"});
}

TEST(ExactTiling, AirborneScan_SameBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(scan, "hobuinc+laz-perf/cpp/test/raw-sets/autzen_trim.las");
  expect_same_bytes(scan, {{"20000", 2, "256MiB", true}, {"none", 1, "", false}, {"100000", 4, "1GiB", true}}, 2);
}

// Thin spray beside a dense plate: sparse queries need more than their tile's halo and are answered from the
// neighbours' files.
TEST(ExactTiling, SparsePointsBesideDenseTiles_AreWidenedToTheSameBytes) {
  const TempFolder folder;
  std::vector<std::array<std::int32_t, 3>> points;
  for (std::int32_t x = 0; x < 220; ++x) {
    for (std::int32_t y = 0; y < 220; ++y) points.push_back({x * 10, y * 10, (x + y) % 3});
  }
  std::uint32_t random = 1;
  const auto next = [&] { return static_cast<std::int32_t>((random = random * 1664525U + 1013904223U) >> 20); };
  for (int i = 0; i < 600; ++i) points.push_back({next() % 2200, next() % 2200, 40 + next() % 400});
  write_las(folder / "spray.las", points);
  ASSERT_EQ(run_arris({"extract", folder / "spray.las", "-o", folder / "out.las", "-q", "--tile-points", "3000",
                       "--report", folder / "report.json"})
                .exit_code,
            0);
  EXPECT_GT(nlohmann::json::parse(file_bytes(folder / "report.json"))["tiles"]["widened_queries"], 0)
      << "the test exercises nothing";
  expect_same_bytes(folder / "spray.las", small_matrix(), 10);
}

}  // namespace
}  // namespace arris::test
