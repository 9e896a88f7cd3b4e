/// @file The whole matrix of exact tiling for supervoxels and the method zheng, on synthetic scenes and (where it is
/// present) real scans. Tens of minutes.

#include <gtest/gtest.h>

#include "supervoxel_tiling.h"
#include "support/coloured_scan.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

struct Variant {
  std::string name;
  bool zheng;
  std::vector<std::string> options;
  bool whole;  ///< The whole matrix on the scenes that have the most to tell; else, and on the others, the small one.

  TilingRun run(int caps_divisor, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = options;
    all.insert(all.end(), more.begin(), more.end());
    return zheng ? zheng_run(all, caps_divisor) : supervoxel_run(all, caps_divisor);
  }
  std::vector<TilingCase> cases() const { return whole ? whole_matrix() : small_matrix(); }
};

class ExactTilingSupervoxelMatrix : public ::testing::TestWithParam<Variant> {};

TEST_P(ExactTilingSupervoxelMatrix, ColouredRoom_SameBytes) {
  const TempFolder folder;
  write_coloured_las(folder / "room.las", coloured_room(120, 65535));
  expect_same_bytes(folder / "room.las", GetParam().cases(), GetParam().run(20, {"--colour", "on"}));
  expect_same_bytes(folder / "room.las", small_matrix(), GetParam().run(20, {"--colour", "off"}));
}

TEST_P(ExactTilingSupervoxelMatrix, ColouredPly_SameBytes) {
  const TempFolder folder;
  write_coloured_ply(folder / "room.ply", coloured_room(100, 255), "uchar");
  expect_same_bytes(folder / "room.ply", small_matrix(), GetParam().run(20, {"--colour", "on"}));
}

TEST_P(ExactTilingSupervoxelMatrix, SimulatedTown_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"town", "--points", "300000", "--noise", "2mm"});
  expect_same_bytes(folder / "scan.las", small_matrix(), GetParam().run(4));
}

TEST_P(ExactTilingSupervoxelMatrix, SyntheticBlock_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"block", "--points", "200000", "--noise", "0.03"});
  expect_same_bytes(folder / "scan.las", small_matrix(), GetParam().run(4));
}

TEST_P(ExactTilingSupervoxelMatrix, PointsOnTileFaces_SameBytes) {
  const TempFolder folder;
  write_points_on_tile_faces(folder / "faces.las");
  expect_same_bytes(folder / "faces.las", GetParam().cases(),
                    GetParam().run(40, {"--voxel", "0.032", "--seed", "0.128"}));
}

TEST_P(ExactTilingSupervoxelMatrix, SprayWithoutSeeds_SameBytes) {
  const TempFolder folder;
  write_spray(folder / "spray.las");
  expect_same_bytes(folder / "spray.las", small_matrix(), GetParam().run(20, {"--seed-support", "0.6"}));
}

TEST_P(ExactTilingSupervoxelMatrix, Duplicates_SameBytes) {
  const TempFolder folder;
  write_duplicates(folder / "twice.las");
  expect_same_bytes(folder / "twice.las", small_matrix(), GetParam().run(20));
}

TEST_P(ExactTilingSupervoxelMatrix, IndoorScan_SameBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(scan, "visgl+loaders.gl/modules/las/test/data/indoor.las");
  expect_same_bytes(scan, small_matrix(), GetParam().run(2));
}

TEST_P(ExactTilingSupervoxelMatrix, AirborneTown_SameBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(scan, "tudelft3d+3dfier/example_data/ahn3/ahn3_cropped_1.las");
  expect_same_bytes(scan, small_matrix(), GetParam().run(2));
}

INSTANTIATE_TEST_SUITE_P(Runs, ExactTilingSupervoxelMatrix,
                         ::testing::Values(Variant{"normal", false, {}, true},
                                           Variant{"fpfh", false, {"--features", "fpfh"}, true},
                                           Variant{"zheng", true, {}, false},
                                           Variant{"improved", true, {"--improved"}, true},
                                           Variant{"zheng_fpfh", true, {"--features", "fpfh"}, false}),
                         [](const auto& variant) { return variant.param.name; });

}  // namespace
}  // namespace arris::test
