/// @file The law of exact tiling for planar segments.

#include <gtest/gtest.h>

#include "support/sanitizers.h"
#include "support/temp_folder.h"
#include "tiling_matrix.h"

namespace arris::test {
namespace {

/// Labels alone.
TilingRun segment_run(const std::vector<std::string>& options, int caps_divisor) {
  return {"segment", options, {}, caps_divisor};
}

/// Labels, contours, table and outlines.
TilingRun contour_run(std::vector<std::string> options, int caps_divisor) {
  options.emplace_back("--contours");
  return {"segment", options, {{"--table", ".csv"}, {"--outlines", ".gpkg"}}, caps_divisor};
}

TEST(ExactTilingSegment, HipRoof_SameBytes) {
  const TempFolder folder;
  synth_scan(folder / "roof.las", {"hip", "--spacing", "0.06", "--noise", "1cm", "--sampling", "random", "--set",
                                   "ground=1", "--set", "walls=1"});
  expect_same_bytes(folder / "roof.las", least_matrix(), contour_run({}, 10));
  if (kThreadSanitizer) return;  // The same threads.
  expect_same_bytes(folder / "roof.las", least_matrix(), segment_run({"--as-published"}, 10));
}

TEST(ExactTilingSegment, Town_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  synth_scan(folder / "town.las", {"town", "--points", "60000", "--noise", "2mm", "--seed", "6"});
  expect_same_bytes(folder / "town.las", small_matrix(), contour_run({}, 10));
  expect_same_bytes(folder / "town.las", least_matrix(), segment_run({"-k", "20"}, 10));
}

// All neighbours within a radius, however many there are.
TEST(ExactTilingSegment, Radius_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  synth_scan(folder / "roof.las", {"crossgable", "--spacing", "0.1", "--noise", "1cm", "--sampling", "random"});
  expect_same_bytes(folder / "roof.las", least_matrix(), segment_run({"--radius", "0.3"}, 20));
}

// Points whose neighbours are far beyond the halo of their tiles.
TEST(ExactTilingSegment, Spray_SameBytes) {
  const TempFolder folder;
  write_spray(folder / "spray.las");
  expect_same_bytes(folder / "spray.las", least_matrix(), segment_run({}, 20));
  if (kThreadSanitizer) return;  // The same threads.
  expect_same_bytes(folder / "spray.las", least_matrix(), segment_run({"--as-published"}, 20));
}

TEST(ExactTilingSegment, Duplicates_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_duplicates(folder / "twice.las");
  expect_same_bytes(folder / "twice.las", least_matrix(), contour_run({}, 20));
}

TEST(ExactTilingSegment, PointsOnTileFaces_SameBytes) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_points_on_tile_faces(folder / "faces.las");
  expect_same_bytes(folder / "faces.las", small_matrix(), contour_run({}, 40));
  expect_same_bytes(folder / "faces.las", least_matrix(), segment_run({"--as-published", "--angle", "60"}, 40));
}

}  // namespace
}  // namespace arris::test
