/// @file The whole matrix of exact tiling, on synthetic scenes and (where it is present) real scans. Minutes.

#include <gtest/gtest.h>

#include "support/arris_process.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tiling_matrix.h"

namespace arris::test {
namespace {

TEST(ExactTilingMatrix, SyntheticBlock_SameBytes) {
  const TempFolder folder;
  ASSERT_EQ(run_arris({"synth", "block", "--points", "200000", "--noise", "0.03", "-o", folder / "scan.las", "--truth",
                       folder / "truth.csv"})
                .exit_code,
            0);
  expect_same_bytes(folder / "scan.las", whole_matrix());
}

TEST(ExactTilingMatrix, SimulatedTown_SameBytes) {
  const TempFolder folder;
  ASSERT_EQ(run_arris({"synth", "town", "--points", "1200000", "--noise", "2mm", "-o", folder / "scan.las", "--truth",
                       folder / "truth.csv"})
                .exit_code,
            0);
  expect_same_bytes(folder / "scan.las", whole_matrix());
}

TEST(ExactTilingMatrix, PointsOnTileFaces_SameBytes) {
  const TempFolder folder;
  write_points_on_tile_faces(folder / "faces.las");
  expect_same_bytes(folder / "faces.las", whole_matrix(), 20);
}

TEST(ExactTilingMatrix, IndoorScan_SameBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(scan, "visgl+loaders.gl/modules/las/test/data/indoor.las");
  expect_same_bytes(scan, whole_matrix());
}

TEST(ExactTilingMatrix, AirborneTown_SameBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(scan, "tudelft3d+3dfier/example_data/ahn3/ahn3_cropped_1.las");
  expect_same_bytes(scan, whole_matrix());
}

}  // namespace
}  // namespace arris::test
