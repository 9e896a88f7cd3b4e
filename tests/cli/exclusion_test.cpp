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

INSTANTIATE_TEST_SUITE_P(
    Flags, Exclusion,
    ::testing::Values(Excluded{"withheld", '\x80', {"--exclude", "withheld"}},
                      Excluded{"synthetic", '\x20', {"--exclude", "overlap,synthetic"}},
                      Excluded{"overlap", '\x0c', {"--exclude", "overlap"}},
                      Excluded{"noise", '\x07', {"--exclude-class", "7,18"}},
                      Excluded{"only", '\x07', {"--only-class", "0,6"}},
                      Excluded{"only_without", '\x07', {"--only-class", "0,7", "--exclude-class", "7"}}),
    [](const auto& excluded) { return std::string(excluded.param.name); });

class OnlyClass : public ::testing::Test {
 protected:
  OnlyClass() {
    write_las(folder_ / "plate.las", square_with_wall(true), 0.01);
    mark(folder_ / "plate.las", 1600, '\x07');
    write_ply("plain.ply", "");
  }
  /// The points of the plate and the wall, ascii, with a property for their class or without.
  void write_ply(const char* name, const std::string& property) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 2360\nproperty float x\nproperty float y\n"
        "property float z\n";
    if (!property.empty()) text += "property uchar " + property + "\n";
    text += "end_header\n";
    std::size_t count = 0;
    for (const auto& p : square_with_wall(true)) {
      for (const std::int32_t c : p) text += std::to_string(0.01 * c) + " ";
      text += property.empty() ? "\n" : count < 1600 ? "6\n" : "7\n";
      ++count;
    }
    write_bytes(folder_ / name, text);
  }
  ProcessResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin() + 1, {"-o", folder_ / "out.las", "--report", folder_ / "run.json"});
    return run_arris(arguments);
  }
  TempFolder folder_;
};

TEST_F(OnlyClass, Ply_IsReadByItsClassification) {
  for (const char* property : {"classification", "scalar_Classification"}) {
    write_ply("classified.ply", property);
    const ProcessResult result = run({"extract", folder_ / "classified.ply", "--only-class", "6", "--overwrite"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(file_bytes(folder_ / "run.json").find("\"excluded\": 760"), std::string::npos) << property;
    std::filesystem::remove(folder_ / "run.json");
  }
}

TEST_F(OnlyClass, PlyWithoutClassification_ExitsWith1AndNamesIt) {
  for (const char* verb : {"extract", "supervoxel"}) {
    const ProcessResult result = run({verb, folder_ / "plate.las", folder_ / "plain.ply", "--only-class", "7"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find("plain.ply"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("classification"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.las"));
  }
}

TEST_F(OnlyClass, NoPointOfTheClass_ExitsWith1AndNamesTheClass) {
  for (const char* verb : {"extract", "supervoxel"}) {
    const ProcessResult result = run({verb, folder_ / "plate.las", "--only-class", "6,17"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find("class 6,17"), std::string::npos) << result.err;
  }
  EXPECT_EQ(run_arris({"plan", folder_ / "plate.las", "--only-class", "6"}).exit_code, 1);
}

TEST_F(OnlyClass, BadOrContradictingClasses_ExitWith2) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--only-class", "256"},
                                                  {"--only-class", "-1"},
                                                  {"--only-class", "roof"},
                                                  {"--only-class", "7", "--exclude-class", "7,18"}}) {
    std::vector<std::string> arguments{"extract", folder_ / "plate.las"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run(arguments).exit_code, 2) << options[1];
  }
}

}  // namespace
}  // namespace arris::test
