/// @file The law of exact tiling, held up by the default method.

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/sanitizers.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tiling_matrix.h"

namespace arris::test {
namespace {

TEST(ExactTiling, PointsOnTileFaces_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_points_on_tile_faces(folder / "faces.las");
  expect_same_bytes(folder / "faces.las", small_matrix(), 20);
}

TEST(ExactTiling, SyntheticBlock_SameBytes) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"block", "--spacing", "0.25", "--noise", "0.05", "--seed", "3"});
  expect_same_bytes(folder / "scan.las", small_matrix(), 10);
}

// Noise of 0.8 spacings: the widest balls, many of them answered from the neighbours' files.
TEST(ExactTiling, NoisyBlock_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"block", "--spacing", "0.6", "--noise", "0.48", "--seed", "3"});
  expect_same_bytes(folder / "scan.las", least_matrix(), 10, {"--refined"});
}

TEST(ExactTiling, RefinedPositions_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"stairs", "--spacing", "0.03", "--noise", "0.006", "--seed", "3"});
  expect_same_bytes(folder / "scan.las", least_matrix(), 10, {"--refined"});
}

TEST(ExactTiling, ThinnedChains_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"plates", "--spacing", "0.1", "--noise", "0.02", "--seed", "3"});
  expect_same_bytes(folder / "scan.las", least_matrix(), 10, {"--thin", "--viewpoint", "5,5,30"});
}

TEST(ExactTiling, Duplicates_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_duplicates(folder / "twice.las");
  expect_same_bytes(folder / "twice.las", small_matrix(), 20);
}

TEST(ExactTiling, SimulatedTown_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"town", "--points", "150000", "--noise", "2mm", "--seed", "4"});
  expect_same_bytes(folder / "scan.las", least_matrix(), 10);
}

// A LAS file of another scale, a PLY and a LAS of the usual kind, with every third point excluded by its class.
TEST(ExactTiling, MixedLayoutsAndExclusions_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder scans;
  synth_scan(scans / "a.las", {"block", "--spacing", "0.4", "--noise", "0.05", "--seed", "1"});
  synth_scan(scans / "b.ply", {"block", "--spacing", "0.4", "--noise", "0.05", "--seed", "2"});
  std::vector<std::array<std::int32_t, 3>> points;
  for (std::int32_t x = -100; x < 100; ++x) {
    for (std::int32_t y = -100; y < 100; ++y) points.push_back({x * 7, y * 7, 900});
  }
  write_las(scans / "c.las", points, 0.01);
  LasView view = view_las(scans / "c.las");
  for (std::uint64_t i = 0; i < view.points; i += 3) view.bytes[view.offset_to_points + i * view.record_bytes + 15] = 7;
  write_bytes(scans / "c.las", view.bytes);
  expect_same_bytes(scans.path(), least_matrix(), 10, {"--exclude-class", "7"});
}

TEST(ExactTiling, AirborneScan_SameBytes) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  ARRIS_SHARED_DATA_OR_SKIP(scan, "hobuinc+laz-perf/cpp/test/raw-sets/autzen_trim.las");
  expect_same_bytes(scan, {{"20000", 2, "256MiB", true}, {"none", 1, "", false}});
}

TEST(ExactTiling, SparsePointsBesideDenseTiles_AreWidenedToTheSameBytes) {
  const TempFolder folder;
  write_spray(folder / "spray.las");
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
