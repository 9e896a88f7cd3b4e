#include <gtest/gtest.h>

#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/sanitizers.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

/// A square of 40 x 40 points, 10 steps apart, with a wall of points over its last column: what is a boundary without
/// the wall is a fold with it.
std::vector<std::array<std::int32_t, 3>> square_with_wall(bool wall) {
  std::vector<std::array<std::int32_t, 3>> points;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) points.push_back({10 * i, 10 * j, 0});
  }
  for (int j = 0; wall && j < 40; ++j) {
    for (int k = 1; k < 20; ++k) points.push_back({390, 10 * j, 10 * k});
  }
  return points;
}

/// Sets byte 15 (class and flags of point formats 0 to 5) of all points from `first` on.
void mark(const std::filesystem::path& path, std::uint64_t first, char value) {
  LasView view = view_las(path);
  for (std::uint64_t i = first; i < view.points; ++i)
    view.bytes[view.offset_to_points + i * view.record_bytes + 15] = value;
  write_bytes(path, view.bytes);
}

struct Excluded {
  const char* name;
  char byte;  ///< Class in bits 0-4, synthetic 5, key point 6, withheld 7.
  std::vector<std::string> options;
};

class Exclusion : public ::testing::TestWithParam<Excluded> {};

TEST_P(Exclusion, ExcludedPoints_TakeNoPartButAreWritten) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  write_las(folder / "plain.las", square_with_wall(false), 0.01);
  write_las(folder / "wall.las", square_with_wall(true), 0.01);
  mark(folder / "wall.las", 1600, GetParam().byte);
  const auto extract = [&](const char* in, const char* out, std::vector<std::string> options) {
    options.insert(options.begin(), {"extract", (folder / in).string(), "-o", (folder / out).string(), "--keep-all"});
    const ProcessResult run = run_arris(options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return view_las(folder / out);
  };
  const LasView plain = extract("plain.las", "a.las", {});
  const LasView wall = extract("wall.las", "b.las", GetParam().options);
  ASSERT_EQ(plain.points, 1600U);
  ASSERT_EQ(wall.points, 1600U + 760U);
  const auto label = [](const LasView& view, std::uint64_t i) { return view.record(i)[view.record_bytes - 9]; };
  std::size_t edges = 0;
  for (std::uint64_t i = 0; i < 1600; ++i) {
    EXPECT_EQ(label(plain, i), label(wall, i)) << i;
    edges += label(plain, i) != 0;
  }
  EXPECT_GT(edges, 100U);
  for (std::uint64_t i = 1600; i < wall.points; ++i) EXPECT_EQ(label(wall, i), 0);
  const LasView with = extract("wall.las", "c.las", {});
  std::size_t changed = 0;
  for (std::uint64_t i = 0; i < 1600; ++i) changed += label(with, i) != label(plain, i);
  EXPECT_GT(changed, 10U) << "the wall matters when it is not excluded";
}

INSTANTIATE_TEST_SUITE_P(Flags, Exclusion,
                         ::testing::Values(Excluded{"withheld", '\x80', {"--exclude", "withheld"}},
                                           Excluded{"synthetic", '\x20', {"--exclude", "overlap,synthetic"}},
                                           Excluded{"overlap", '\x0c', {"--exclude", "overlap"}},
                                           Excluded{"noise", '\x07', {"--exclude-class", "7,18"}}),
                         [](const auto& excluded) { return std::string(excluded.param.name); });

}  // namespace
}  // namespace arris::test
