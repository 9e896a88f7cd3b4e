/// @file The whole matrix of exact tiling, on synthetic scenes and (where it is present) real scans; a smaller one for
/// the method liu. Tens of minutes.

#include <gtest/gtest.h>

#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tiling_matrix.h"

namespace arris::test {
namespace {

struct MethodRuns {
  std::string method;
  std::vector<TilingCase> cases;
};

class ExactTilingMatrix : public ::testing::TestWithParam<MethodRuns> {
 protected:
  void expect_same(const std::filesystem::path& scan, int caps_divisor = 1) {
    std::vector<std::string> options{"--method", GetParam().method};
    if (GetParam().method == "arris") options.push_back("--refined");
    expect_same_bytes(scan, GetParam().cases, caps_divisor, options);
  }
};

TEST_P(ExactTilingMatrix, SyntheticBlock_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"block", "--points", "200000", "--noise", "0.03"});
  expect_same(folder / "scan.las");
}

TEST_P(ExactTilingMatrix, SimulatedTown_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"town", "--points", "600000", "--noise", "2mm"});
  expect_same(folder / "scan.las", 2);
}

TEST_P(ExactTilingMatrix, PointsOnTileFaces_SameBytes) {
  const TempFolder folder;
  write_points_on_tile_faces(folder / "faces.las");
  expect_same(folder / "faces.las", 20);
}

TEST_P(ExactTilingMatrix, Duplicates_SameBytes) {
  const TempFolder folder;
  write_duplicates(folder / "twice.las");
  expect_same(folder / "twice.las", 20);
}

TEST_P(ExactTilingMatrix, IndoorScan_SameBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(scan, "visgl+loaders.gl/modules/las/test/data/indoor.las");
  expect_same(scan);
}

TEST_P(ExactTilingMatrix, AirborneTown_SameBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(scan, "tudelft3d+3dfier/example_data/ahn3/ahn3_cropped_1.las");
  expect_same(scan);
}

INSTANTIATE_TEST_SUITE_P(Method, ExactTilingMatrix,
                         ::testing::Values(MethodRuns{"arris", whole_matrix()}, MethodRuns{"liu", small_matrix()}),
                         [](const auto& runs) { return runs.param.method; });

// Noise of 0.8 spacings: the widest balls.
TEST(ExactTilingMatrixNoisy, Block_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"block", "--spacing", "0.25", "--noise", "0.2"});
  expect_same_bytes(folder / "scan.las", small_matrix(), 5, {"--refined"});
}

}  // namespace
}  // namespace arris::test
