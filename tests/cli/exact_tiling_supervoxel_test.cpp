/// @file The law of exact tiling for supervoxels, whose tiles are of voxels, and for the method zheng that begins with
/// them.

#include <gtest/gtest.h>

#include "supervoxel_tiling.h"
#include "support/coloured_scan.h"
#include "support/sanitizers.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

TEST(ExactTilingSupervoxel, ColouredRoom_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_coloured_las(folder / "room.las", coloured_room(60, 65535));
  for (const char* features : {"normal", "fpfh"}) {
    for (const char* colour : {"on", "off"}) {
      SCOPED_TRACE(std::string(features) + ", colour " + colour);
      expect_same_bytes(folder / "room.las", least_matrix(),
                        supervoxel_run({"--features", features, "--colour", colour}, 40));
    }
  }
}

// The halves that a split makes look like other ranges of colours.
TEST(ExactTilingSupervoxel, ColouredPly_SameBytes) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  const TempFolder folder;
  auto points = coloured_room(50, 255);
  for (std::size_t i = 0; i < points.size() / 5; ++i) points[i].colour = {1, 0, 1};
  write_coloured_ply(folder / "room.ply", points, "uchar");
  expect_same_bytes(folder / "room.ply", least_matrix(),
                    supervoxel_run({"--features", "fpfh", "--colour", "on", "--voxel", "20mm"}, 100));
  for (auto& p : points) {
    for (double& channel : p.colour) channel /= 255.0;
  }
  write_coloured_ply(folder / "float.ply", points, "float");
  expect_same_bytes(folder / "float.ply", least_matrix(),
                    supervoxel_run({"--colour", "on", "--voxel", "20mm", "--seed", "90mm"}, 100));
}

TEST(ExactTilingSupervoxel, PointsOnTileFaces_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_points_on_tile_faces(folder / "faces.las");
  expect_same_bytes(folder / "faces.las", small_matrix(), supervoxel_run({"--voxel", "0.032", "--seed", "0.128"}, 40));
}

TEST(ExactTilingSupervoxel, SimulatedTown_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"town", "--points", "60000", "--noise", "2mm", "--seed", "4"});
  expect_same_bytes(folder / "scan.las", least_matrix(), supervoxel_run({}, 10));
}

// Spray: groups of voxels that no seed reaches, across the borders of tiles.
TEST(ExactTilingSupervoxel, SprayWithoutSeeds_SameBytes) {
  const TempFolder folder;
  write_spray(folder / "spray.las");
  expect_same_bytes(folder / "spray.las", least_matrix(),
                    supervoxel_run({"--seed-support", "0.6", "--iterations", "2"}, 20));
}

TEST(ExactTilingZheng, SyntheticBlock_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"block", "--spacing", "0.3", "--noise", "0.05", "--seed", "3"});
  expect_same_bytes(folder / "scan.las", least_matrix(), zheng_run({}, 10));
  expect_same_bytes(folder / "scan.las", least_matrix(), zheng_run({"--improved"}, 20));
}

TEST(ExactTilingZheng, ColouredRoom_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_coloured_las(folder / "room.las", coloured_room(60, 65535));
  expect_same_bytes(folder / "room.las", least_matrix(), zheng_run({"--features", "fpfh", "--colour", "on"}, 40));
}

TEST(ExactTilingZheng, Duplicates_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_duplicates(folder / "twice.las");
  expect_same_bytes(folder / "twice.las", least_matrix(), zheng_run({"--improved"}, 20));
}

TEST(ExactTilingZheng, SimulatedTown_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "scan.las", {"town", "--points", "40000", "--noise", "2mm", "--seed", "5"});
  expect_same_bytes(folder / "scan.las", least_matrix(), zheng_run({"--improved"}, 10));
}

}  // namespace
}  // namespace arris::test
