/// @file Input on the edge of having points at all: each has a defined result.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

ProcessResult extract(const TempFolder& folder, const char* name) {
  return run_arris({"extract", folder / name, "-o", folder / "out.las", "-q"});
}

TEST(DegenerateInput, EmptyFile_GivesAnEmptyScan) {
  const TempFolder folder;
  write_las(folder / "in.las", {});
  const ProcessResult run = extract(folder, "in.las");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(view_las(folder / "out.las").points, 0U);
}

TEST(DegenerateInput, OnePoint_IsNoContour) {
  const TempFolder folder;
  write_las(folder / "in.las", {{5, -7, 9}});
  const ProcessResult run = extract(folder, "in.las");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(view_las(folder / "out.las").points, 0U);
}

TEST(DegenerateInput, AllPointsEqual_AreNoContour) {
  const TempFolder folder;
  write_las(folder / "in.las", std::vector<std::array<std::int32_t, 3>>(5000, {1, 2, 3}));
  const ProcessResult run = extract(folder, "in.las");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(view_las(folder / "out.las").points, 0U);
}

TEST(DegenerateInput, CoordinatesAtTheEndsOfInt32_AreRead) {
  const TempFolder folder;
  write_las(folder / "in.las", {{INT32_MIN, INT32_MIN, INT32_MIN}, {INT32_MAX, INT32_MAX, INT32_MAX}, {0, 0, 0}});
  const ProcessResult run = run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "-q", "--keep-all"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const LasView out = view_las(folder / "out.las");
  ASSERT_EQ(out.points, 3U);
  EXPECT_EQ(out.position(0)[0], INT32_MIN);
  EXPECT_EQ(out.position(1)[2], INT32_MAX);
}

TEST(DegenerateInput, NanCoordinates_AreCountedAndKeptOut) {
  const TempFolder folder;
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 903\nproperty double x\nproperty double y\nproperty double "
      "z\nend_header\n";
  for (int i = 0; i < 900; ++i) ply += std::to_string(i % 30) + " " + std::to_string(i / 30) + " 0\n";
  ply += "nan 1 2\n1 nan 2\n1 2 inf\n";
  write_bytes(folder / "in.ply", ply);
  const ProcessResult run = run_arris({"extract", folder / "in.ply", "-o", folder / "out.ply"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("3 points have NaN or infinite coordinates"), std::string::npos) << run.err;
  const std::string out = file_bytes(folder / "out.ply");
  EXPECT_NE(out.find("EdgeClass"), std::string::npos);
  EXPECT_EQ(out.find("nan"), std::string::npos);
}

TEST(DegenerateInput, DuplicatesOfAContourPoint_AllGetItsLabel) {
  const TempFolder folder;
  std::vector<std::array<std::int32_t, 3>> points;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) points.push_back({i * 100, j * 100, 0});
  }
  const std::vector<std::array<std::int32_t, 3>> once = points;
  write_las(folder / "once.las", once);
  points.insert(points.end(), once.begin(), once.end());
  write_las(folder / "twice.las", points);
  ASSERT_EQ(run_arris({"extract", folder / "once.las", "-o", folder / "once_out.las", "-q"}).exit_code, 0);
  ASSERT_EQ(run_arris({"extract", folder / "twice.las", "-o", folder / "twice_out.las", "-q"}).exit_code, 0);
  const LasView a = view_las(folder / "once_out.las");
  const LasView b = view_las(folder / "twice_out.las");
  ASSERT_GT(a.points, 100U);
  ASSERT_EQ(b.points, 2 * a.points);
  for (std::uint64_t i = 0; i < a.points; ++i) {
    EXPECT_EQ(std::string(a.record(i), a.record_bytes), std::string(b.record(i), b.record_bytes));
    EXPECT_EQ(std::string(a.record(i), a.record_bytes), std::string(b.record(a.points + i), b.record_bytes));
  }
}

}  // namespace
}  // namespace arris::test
