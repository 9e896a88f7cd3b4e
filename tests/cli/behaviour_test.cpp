/// @file What users and scripts rely on: exit codes, error lines, whole outputs, nothing left behind.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/sanitizers.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

using Positions = std::vector<std::array<std::int32_t, 3>>;

/// A square plate: four boundaries.
Positions plate(int side) {
  Positions points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) points.push_back({i * 100, j * 100, 0});
  }
  return points;
}

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

long lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST(Behaviour, HelpAndVersion_SucceedOnStdout) {
  for (const char* option : {"--help", "--version"}) {
    const ProcessResult run = run_arris({option});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_NE(run.out.find("arris"), std::string::npos);
    EXPECT_EQ(run.err, "");
  }
  EXPECT_NE(run_arris({"--version"}).out.find("OpenVDB"), std::string::npos);
}

TEST(Behaviour, UsageErrors_ExitWith2AndOneLine) {
  const TempFolder folder;
  write_las(folder / "in.las", plate(10));
  const std::string in = folder / "in.las";
  const std::vector<std::vector<std::string>> wrong{
      {},
      {"nonsense"},
      {"extract", in},
      {"extract", in, "-o", folder / "out.xyz"},
      {"extract", in, "-o", folder / "o.las", "--memory", "lots"},
      {"extract", in, "-o", folder / "o.las", "--method", "liu", "--k-min", "50"},
      {"extract", in, "-o", folder / "o.las", "--alpha", "100"},
      {"extract", in, "-o", folder / "o.las", "--precision", "1.5"},
      {"extract", in, "-o", folder / "o.las", "--tile-points", "0"},
      {"extract", in, "-o", folder / "o.las", "--radius", "5 parsec"},
      {"extract", in, "-o", in, "--overwrite"}};
  for (const auto& arguments : wrong) {
    const ProcessResult run = run_arris(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_EQ(run.out, "");
  }
  EXPECT_EQ(entries(folder.path()), 1U) << "something was left behind";
}

TEST(Behaviour, BadInput_ExitsWith1NamesTheFileAndLeavesNothing) {
  const TempFolder folder;
  write_bytes(folder / "junk.las", "this is no scan at all");
  Positions points = plate(20);
  write_las(folder / "cut.las", points);
  std::filesystem::resize_file(folder / "cut.las", 227 + 20 * 100 + 7);
  for (const char* name : {"junk.las", "cut.las", "absent.las"}) {
    const ProcessResult run = run_arris({"extract", folder / name, "-o", folder / "out.las"});
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_NE(run.err.find(name), std::string::npos) << run.err;
  }
  EXPECT_EQ(entries(folder.path()), 2U);
}

TEST(Behaviour, TinyBudget_ExitsWith3AndSaysWhatWouldDo) {
  const TempFolder folder;
  write_las(folder / "in.las", plate(20));
  const ProcessResult run = run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "--memory", "10MiB"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("at least"), std::string::npos) << run.err;
  const ProcessResult disk = run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "--max-temp", "1kB"});
  EXPECT_EQ(disk.exit_code, 3);
  EXPECT_NE(disk.err.find("--max-temp"), std::string::npos) << disk.err;
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(Behaviour, ExistingOutput_IsNotTouchedWithoutOverwrite) {
  const TempFolder folder;
  write_las(folder / "in.las", plate(20));
  write_bytes(folder / "out.las", "precious");
  const ProcessResult run = run_arris({"extract", folder / "in.las", "-o", folder / "out.las"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--overwrite"), std::string::npos) << run.err;
  EXPECT_EQ(file_bytes(folder / "out.las"), "precious");
  EXPECT_EQ(run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(file_bytes(folder / "out.las").substr(0, 4), "LASF");
}

TEST(Behaviour, Plate_EdgePointsAreExactlyTheBoundaryAndRecordsAreKept) {
  const TempFolder folder;
  const int side = 40;
  write_las(folder / "in.las", plate(side));
  const ProcessResult run = run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "--report",
                                       folder / "report.json", "--temp-dir", folder.path()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const LasView in = view_las(folder / "in.las");
  const LasView out = view_las(folder / "out.las");
  EXPECT_EQ(out.record_bytes, in.record_bytes + 9);
  std::size_t on_border = 0;
  for (std::uint64_t i = 0; i < out.points; ++i) {
    const auto p = out.position(i);
    on_border += p[0] == 0 || p[1] == 0 || p[0] == 100 * (side - 1) || p[1] == 100 * (side - 1);
    const auto original = static_cast<std::uint64_t>(p[0] / 100 * side + p[1] / 100);
    EXPECT_EQ(std::string(out.record(i), in.record_bytes), std::string(in.record(original), in.record_bytes));
  }
  EXPECT_EQ(on_border, 4U * (side - 1)) << "every border point is found";
  EXPECT_LE(out.points, on_border + 8) << "and hardly anything else";
  const auto report = nlohmann::json::parse(file_bytes(folder / "report.json"));
  const auto& points = report["points"];
  EXPECT_EQ(points["in"].get<std::uint64_t>(), in.points);
  EXPECT_EQ(points["out"].get<std::uint64_t>() + points["not_contour"].get<std::uint64_t>() +
                points["dropped"]["non_finite"].get<std::uint64_t>() +
                points["dropped"]["out_of_range"].get<std::uint64_t>(),
            in.points);
  EXPECT_LE(report["memory"]["measured_peak_bytes"].get<std::uint64_t>(),
            report["memory"]["budget_bytes"].get<std::uint64_t>());
  EXPECT_EQ(entries(folder.path()), 3U) << "temporary files stayed behind";
}

TEST(Behaviour, KeepAll_KeepsEveryRecordInOrder) {
  const TempFolder folder;
  write_las(folder / "in.las", plate(30));
  ASSERT_EQ(run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "--keep-all", "-q"}).exit_code, 0);
  const LasView in = view_las(folder / "in.las");
  const LasView out = view_las(folder / "out.las");
  ASSERT_EQ(out.points, in.points);
  for (std::uint64_t i = 0; i < in.points; ++i) {
    ASSERT_EQ(std::string(out.record(i), in.record_bytes), std::string(in.record(i), in.record_bytes));
  }
}

TEST(Behaviour, ShiftByUtmCoordinates_ChangesNoLabel) {
  const TempFolder folder;
  write_las(folder / "near.las", plate(40));
  write_las(folder / "far.las", plate(40), 0.001, {500'000.0, 5'000'000.0, 100.0});
  for (const char* name : {"near", "far"}) {
    ASSERT_EQ(run_arris({"extract", folder.path() / (std::string(name) + ".las"), "-o",
                         folder.path() / (std::string(name) + "_out.las"), "-q"})
                  .exit_code,
              0);
  }
  const LasView near = view_las(folder / "near_out.las");
  const LasView far = view_las(folder / "far_out.las");
  ASSERT_EQ(near.points, far.points);
  EXPECT_EQ(near.bytes.substr(near.offset_to_points), far.bytes.substr(far.offset_to_points));
}

TEST(Behaviour, SeveralOutputsAndAFolderAsInput_Work) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "scans");
  const Positions points = plate(30);
  write_las(folder.path() / "scans" / "a.las", Positions(points.begin(), points.begin() + 400));
  write_las(folder.path() / "scans" / "b.LAS", Positions(points.begin() + 400, points.end()));
  const ProcessResult run =
      run_arris({"extract", folder / "scans", "-o", folder / "out.las", "-o", folder / "out.ply"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_GT(view_las(folder / "out.las").points, 100U);
  EXPECT_NE(file_bytes(folder / "out.ply").find("property float EdgeScore"), std::string::npos);
}

TEST(Behaviour, PlanPrintsAndTouchesNothing) {
  const TempFolder folder;
  write_las(folder / "in.las", plate(30));
  const ProcessResult run = run_arris({"plan", folder / "in.las", "--temp-dir", folder.path()});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("tiles"), std::string::npos);
  EXPECT_NE(run.out.find("peak memory"), std::string::npos);
  EXPECT_EQ(entries(folder.path()), 1U);
  EXPECT_EQ(nlohmann::json::parse(run_arris({"plan", folder / "in.las", "--json"}).out)["points"]["in"], 900);
  const ProcessResult segments = run_arris({"plan", "segment", folder / "in.las", "-k", "12", "--json"});
  ASSERT_EQ(segments.exit_code, 0) << segments.err;
  EXPECT_EQ(nlohmann::json::parse(segments.out)["parameters"]["neighbours"], 12);
  EXPECT_EQ(entries(folder.path()), 1U);
  const ProcessResult supervoxels = run_arris({"plan", "supervoxel", folder / "in.las", "--json"});
  EXPECT_EQ(supervoxels.exit_code, 0) << supervoxels.err;
  EXPECT_GT(nlohmann::json::parse(supervoxels.out)["voxels"], 0);
  EXPECT_EQ(run_arris({"plan"}).exit_code, 2);
}

TEST(Behaviour, Info_ShowsCountsAndFindsAWrongBox) {
  const TempFolder folder;
  write_las(folder / "in.las", plate(30));
  std::string bytes = file_bytes(folder / "in.las");
  const double wrong = 1e6;
  std::memcpy(bytes.data() + 179, &wrong, sizeof wrong);
  write_bytes(folder / "wrong.las", bytes);
  EXPECT_NE(run_arris({"info", folder / "in.las"}).out.find("900"), std::string::npos);
  const auto json = nlohmann::json::parse(run_arris({"info", folder / "wrong.las", "--json"}).out);
  EXPECT_EQ(json["files"][0]["points"], 900);
  EXPECT_NE(json["files"][0]["problems"].dump().find("bbox"), std::string::npos) << json.dump(1);
}

TEST(Behaviour, Interrupt_ExitsWith130AndLeavesNothing) {
  const TempFolder folder;
  ASSERT_EQ(run_arris({"synth", "plane", "--points", "1500000", "-o", folder / "in.las", "--truth",
                       folder / "truth.csv", "-q"})
                .exit_code,
            0);
  std::filesystem::create_directory(folder / "temp");
  const ProcessResult run = run_arris(
      {"extract", folder / "in.las", "-o", folder / "out.las", "--temp-dir", folder / "temp", "--tile-points", "20000"},
      [&](int pid) {  // Once it has begun to write; how long a program takes to start differs from machine to machine.
        for (int waited_ms = 0; waited_ms < 60000 && entries(folder / "temp") == 0; ++waited_ms)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        kill(pid, SIGINT);
      });
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_EQ(entries(folder / "temp"), 0U);
  EXPECT_EQ(entries(folder.path()), 3U) << "in.las, truth.csv and the empty temp";
}

TEST(Behaviour, JsonProgress_IsOneObjectALine) {
  const TempFolder folder;
  write_las(folder / "in.las", plate(60));
  const ProcessResult run = run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "--progress", "json"});
  ASSERT_EQ(run.exit_code, 0);
  std::size_t begin = 0;
  int phases = 0;
  while (begin < run.err.size()) {
    const std::size_t end = run.err.find('\n', begin);
    phases += nlohmann::json::parse(run.err.substr(begin, end - begin)).value("event", "") == "phase";
    begin = end + 1;
  }
  EXPECT_GE(phases, 3);
}

TEST(Behaviour, ConfigFile_SetsOptionsAndTheCommandLineWins) {
  const TempFolder folder;
  write_las(folder / "in.las", plate(30));
  write_bytes(folder / "f.toml", "method = \"liu\"\nk-min = 25\nalpha = 100\n");
  ASSERT_EQ(run_arris({"extract", folder / "in.las", "-o", folder / "out.las", "--config", folder / "f.toml", "--alpha",
                       "110", "--report", folder / "r.json"})
                .exit_code,
            0);
  const auto report = nlohmann::json::parse(file_bytes(folder / "r.json"));
  EXPECT_EQ(report["method"], "liu");
  EXPECT_EQ(report["parameters"]["k_min"], 25);
  EXPECT_EQ(report["parameters"]["gap_deg"], 110.0);
}

TEST(Behaviour, Thin_KeepsAChainOutOfTheContourPoints) {
  ARRIS_SKIP_UNDER_THREAD_SANITIZER;
  const TempFolder folder;
  ASSERT_EQ(
      run_arris({"synth", "gable", "--noise", "0.02", "-o", folder / "in.las", "--truth", folder / "t.csv"}).exit_code,
      0);
  const auto extract = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"extract", folder / "in.las", "-o", folder / "out.las", "--overwrite", "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run_arris(arguments).exit_code, 0);
    const LasView out = view_las(folder / "out.las");
    std::set<std::string> originals;
    for (std::uint64_t i = 0; i < out.points; ++i) originals.insert(std::string(out.record(i), out.record_bytes));
    return originals;
  };
  const std::set<std::string> all = extract({});
  const std::set<std::string> thin = extract({"--thin"});
  EXPECT_LT(thin.size(), 0.9 * static_cast<double>(all.size()));
  EXPECT_GT(thin.size(), all.size() / 4);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), thin.begin(), thin.end())) << "nothing new, nothing changed";
}

TEST(Behaviour, FullDisk_ExitsWith1AndLeavesNoOutput) {
  const TempFolder folder;
  write_las(folder / "in.las", plate(30));
  const ProcessResult run = run_arris({"extract", folder / "in.las", "-o", "/dev/full/out.las"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_EQ(lines(run.err), 1) << run.err;
}

}  // namespace
}  // namespace arris::test
