/// @file The law of exact tiling for the method liu, whose records concern points of other tiles too.

#include <gtest/gtest.h>

#include "support/sanitizers.h"
#include "support/temp_folder.h"
#include "tiling_matrix.h"

namespace arris::test {
namespace {

const std::vector<std::string> kLiu{"--method", "liu"};

TEST(ExactTilingLiu, PointsOnTileFaces_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_points_on_tile_faces(folder / "faces.las");
  expect_same_bytes(folder / "faces.las", least_matrix(), 20, kLiu);
}

TEST(ExactTilingLiu, SyntheticBlock_SameBytes) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"block", "--spacing", "0.25", "--noise", "0.05", "--seed", "3"});
  expect_same_bytes(folder / "scan.las", least_matrix(), 10, kLiu);
}

TEST(ExactTilingLiu, SimulatedTown_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"town", "--points", "100000", "--noise", "2mm", "--seed", "4"});
  expect_same_bytes(folder / "scan.las", least_matrix(), 10, kLiu);
}

TEST(ExactTilingLiu, SparsePointsBesideDenseTiles_SameBytes) {
  const TempFolder folder;
  write_spray(folder / "spray.las");
  expect_same_bytes(folder / "spray.las", least_matrix(), 10, kLiu);
}

TEST(ExactTilingLiu, Duplicates_SameBytes) {
  const TempFolder folder;
  write_duplicates(folder / "twice.las");
  expect_same_bytes(folder / "twice.las", least_matrix(), 20, kLiu);
}

}  // namespace
}  // namespace arris::test
