/// @file What `cmake --install` puts down works where it stands, and says so if a part of it is missing.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

TEST(Install, Program_RunsFromItsPrefixAndNamesAMissingPart) {
  const TempFolder prefix;
  const std::string command =
      std::string(ARRIS_CMAKE) + " --install " + ARRIS_BUILD + " --prefix " + prefix.path().string() + " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  // Moved: nothing in it may depend on where it was made or installed.
  const TempFolder elsewhere;
  const std::filesystem::path moved = elsewhere / "moved";
  std::filesystem::rename(prefix.path(), moved);
  ASSERT_EQ(setenv("ARRIS_PROGRAM", (moved / "bin" / "arris").c_str(), 1), 0);

  const std::string scan = elsewhere / "scan.las", out = elsewhere / "out.las";
  EXPECT_EQ(run_arris({"--version"}).exit_code, 0);
  ASSERT_EQ(run_arris({"synth", "plane", "--points", "20000", "-o", scan}).exit_code, 0);
  const ProcessResult run = run_arris({"extract", scan, "-o", out});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(out));

  std::filesystem::path part;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(moved)) {
    if (entry.path().filename() == "arris_vdb.so") part = entry.path();
  }
  ASSERT_FALSE(part.empty());
  std::filesystem::remove(part);
  std::filesystem::remove(out);
  for (const char* threads : {"1", "2"}) {
    const ProcessResult broken = run_arris({"extract", scan, "-o", out, "--threads", threads});
    EXPECT_EQ(broken.exit_code, 1);
    EXPECT_NE(broken.err.find("arris_vdb.so"), std::string::npos) << broken.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
  // Needs no grids of points.
  EXPECT_EQ(run_arris({"supervoxel", scan, "--voxel", "0.1", "--seed", "0.8", "-o", out}).exit_code, 0);
}

}  // namespace
}  // namespace arris::test
