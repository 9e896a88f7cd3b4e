/// @file The whole matrix of exact tiling for planar segments, on synthetic scenes and (where it is present) real
/// scans. Tens of minutes.

#include <gtest/gtest.h>

#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tiling_matrix.h"

namespace arris::test {
namespace {

struct Variant {
  std::string name;
  std::vector<std::string> options;

  TilingRun run(int caps_divisor, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = options;
    all.insert(all.end(), more.begin(), more.end());
    all.emplace_back("--contours");
    return {"segment", all, {{"--table", ".csv"}, {"--outlines", ".gpkg"}}, caps_divisor};
  }
};

class ExactTilingSegmentMatrix : public ::testing::TestWithParam<Variant> {};

TEST_P(ExactTilingSegmentMatrix, SimulatedTown_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "town.las", {"town", "--points", "300000", "--noise", "2mm"});
  expect_same_bytes(folder / "town.las", small_matrix(), GetParam().run(4));
}

TEST_P(ExactTilingSegmentMatrix, Roof_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "roof.las", {"mansard", "--points", "100000", "--noise", "1cm", "--sampling", "random"});
  expect_same_bytes(folder / "roof.las", whole_matrix(), GetParam().run(10));
}

TEST_P(ExactTilingSegmentMatrix, PointsOnTileFaces_SameBytes) {
  const TempFolder folder;
  write_points_on_tile_faces(folder / "faces.las");
  expect_same_bytes(folder / "faces.las", whole_matrix(), GetParam().run(40));
}

TEST_P(ExactTilingSegmentMatrix, Spray_SameBytes) {
  const TempFolder folder;
  write_spray(folder / "spray.las");
  expect_same_bytes(folder / "spray.las", small_matrix(), GetParam().run(20));
}

TEST_P(ExactTilingSegmentMatrix, Duplicates_SameBytes) {
  const TempFolder folder;
  write_duplicates(folder / "twice.las");
  expect_same_bytes(folder / "twice.las", small_matrix(), GetParam().run(20));
}

TEST_P(ExactTilingSegmentMatrix, AirborneTown_SameBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(scan, "tudelft3d+3dfier/example_data/ahn3/ahn3_cropped_1.las");
  expect_same_bytes(scan, small_matrix(), GetParam().run(2));
  expect_same_bytes(scan, small_matrix(), GetParam().run(2, {"--min-height", "1.5m"}));
}

TEST_P(ExactTilingSegmentMatrix, Houses_SameBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(scan, "IGNF+lidar-prod/tests/files/870000_6618000.subset.postValidation.las");
  expect_same_bytes(scan, small_matrix(), GetParam().run(10, {"--only-class", "1,6"}));
}

INSTANTIATE_TEST_SUITE_P(Runs, ExactTilingSegmentMatrix,
                         ::testing::Values(Variant{"improved", {}}, Variant{"published", {"--as-published"}},
                                           Variant{"wide", {"-k", "30"}}, Variant{"radius", {"--radius", "0.5"}}),
                         [](const auto& variant) { return variant.param.name; });

}  // namespace
}  // namespace arris::test
