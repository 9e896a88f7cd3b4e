/// @file How `arris supervoxel`, and the method zheng that begins with it, refuse to run.

#include <gtest/gtest.h>

#include <algorithm>

#include "supervoxel_runs.h"
#include "support/coloured_scan.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

struct Wrong {
  std::vector<std::string> options;
  std::string named;  ///< In the error line.
};

TEST(SupervoxelErrors, WrongOptions_ExitWith2AndOneLineThatNamesThem) {
  const TempFolder folder;
  write_las(folder / "in.las", noisy_plate(30, 10));
  write_bytes(folder / "there.csv", "precious");
  const std::string out = folder / "out.las";
  for (const Wrong& wrong :
       {Wrong{{}, "--output"}, Wrong{{"-o", folder / "out.xyz"}, "out.xyz"},
        Wrong{{"-o", folder / "in.las", "--overwrite"}, "in.las"},
        Wrong{{"-o", out, "--table", folder / "t.txt"}, "--table"},
        Wrong{{"-o", out, "--adjacency", folder / "a"}, "--adjacency"},
        Wrong{{"-o", out, "--table", folder / "there.csv"}, "--overwrite"},
        Wrong{{"-o", out, "--voxel", "1cm", "--seed", "1.9cm"}, "--seed"},
        Wrong{{"-o", out, "--voxel", "0.1mm"}, "--voxel"}, Wrong{{"-o", out, "--voxel", "5 parsec"}, "5 parsec"},
        Wrong{{"-o", out, "--iterations", "0"}, "--iterations"}, Wrong{{"-o", out, "--mu", "-1"}, "weights"},
        Wrong{{"-o", out, "--colour", "on"}, "--colour"}, Wrong{{"-o", out, "--colour", "blue"}, "--colour"},
        Wrong{{"-o", out, "--features", "all"}, "--features"}}) {
    std::vector<std::string> arguments{"supervoxel", folder / "in.las", "--temp-dir", folder.path()};
    arguments.insert(arguments.end(), wrong.options.begin(), wrong.options.end());
    const ProcessResult run = run_arris(arguments);
    EXPECT_EQ(run.exit_code, 2) << wrong.named << ": " << run.err;
    EXPECT_NE(run.err.find(wrong.named), std::string::npos) << wrong.named << ": " << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(entries(folder.path()), 2U) << wrong.named << ": something was left behind";
  }
  EXPECT_EQ(file_bytes(folder / "there.csv"), "precious");
}

TEST(SupervoxelErrors, ExistingOutput_IsNotTouchedWithoutOverwrite) {
  const TempFolder folder;
  write_las(folder / "in.las", noisy_plate(30, 10));
  write_bytes(folder / "out.las", "precious");
  const ProcessResult run = run_arris({"supervoxel", folder / "in.las", "-o", folder / "out.las"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--overwrite"), std::string::npos) << run.err;
  EXPECT_EQ(file_bytes(folder / "out.las"), "precious");
  label(folder / "in.las", folder / "out.las");
  EXPECT_EQ(file_bytes(folder / "out.las").substr(0, 4), "LASF");
}

TEST(SupervoxelErrors, BadInput_ExitsWith1AndNamesTheFile) {
  const TempFolder folder;
  write_bytes(folder / "junk.las", "this is no scan at all");
  for (const char* name : {"junk.las", "absent.las"}) {
    const ProcessResult run = run_arris({"supervoxel", folder / name, "-o", folder / "out.las"});
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_NE(run.err.find(name), std::string::npos) << run.err;
  }
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(SupervoxelErrors, BudgetOrDiskTooSmall_ExitsWith3AndSaysWhatWouldDo) {
  const TempFolder folder;
  write_las(folder / "in.las", noisy_plate(30, 10));
  for (const std::vector<std::string>& verb :
       {std::vector<std::string>{"supervoxel"}, {"extract", "--method", "zheng"}}) {
    std::vector<std::string> arguments = verb;
    arguments.insert(arguments.end(), {folder / "in.las", "-o", folder / "out.las", "--memory", "10MiB"});
    const ProcessResult memory = run_arris(arguments);
    EXPECT_EQ(memory.exit_code, 3) << memory.err;
    EXPECT_NE(memory.err.find("at least"), std::string::npos) << memory.err;
    arguments.erase(arguments.end() - 2, arguments.end());
    arguments.insert(arguments.end(), {"--max-temp", "1kB"});
    const ProcessResult disk = run_arris(arguments);
    EXPECT_EQ(disk.exit_code, 3) << disk.err;
    EXPECT_NE(disk.err.find("--max-temp"), std::string::npos) << disk.err;
  }
  EXPECT_EQ(entries(folder.path()), 1U);
}

// The budget that the message names is enough.
TEST(SupervoxelErrors, LeastBudgetNamed_Does) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's own memory counts as resident";
#endif
  const TempFolder folder;
  write_las(folder / "in.las", noisy_plate(100, 10));
  std::vector<std::string> arguments{"supervoxel", folder / "in.las", "-o",   folder / "out.las",
                                     "-q",         "--memory",        "10MiB"};
  const ProcessResult refused = run_arris(arguments);
  const std::string least = refused.err.substr(refused.err.find("at least ") + 9);
  std::string size = least.substr(0, least.find('\n'));
  size.erase(std::remove(size.begin(), size.end(), ' '), size.end());
  arguments.back() = size;
  const ProcessResult run = run_arris(arguments);
  EXPECT_EQ(run.exit_code, 0) << size << ": " << run.err;
  EXPECT_LE(run.peak_resident_bytes, std::stod(size) * 1024 * 1024) << size;
}

TEST(SupervoxelErrors, OptionsThatZhengDoesNotHave_AreRefused) {
  const TempFolder folder;
  write_las(folder / "in.las", noisy_plate(30, 10));
  for (const char* option : {"--max-radius", "--alpha", "--precision"}) {
    const ProcessResult run =
        run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "--method", "zheng", option, "1"});
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_NE(run.err.find(option), std::string::npos) << run.err;
  }
  const ProcessResult other = run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "--voxel", "1cm"});
  EXPECT_EQ(other.exit_code, 2) << "the default method has no voxels: " << other.err;
}

}  // namespace
}  // namespace arris::test
