#include "tiling_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/ply_tools.h"
#include "support/sanitizers.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

/// Under sanitizers so much that no run is refused: their own memory, and what they keep of freed memory, counts as
/// resident.
std::string budget_of(const TilingCase& c) {
  if (!kAddressSanitizer && !kThreadSanitizer) return c.memory;
  return c.memory == "256MiB" ? "4GiB" : "6GiB";
}

std::string cap_of(const TilingCase& c, const TilingRun& run) {
  return c.tile_points == "none" ? c.tile_points : std::to_string(std::stoi(c.tile_points) / run.caps_divisor);
}

std::vector<std::string> arguments_of(const TilingCase& c, const TilingRun& run) {
  std::vector<std::string> arguments{run.verb, "--tile-points", cap_of(c, run), "--threads", std::to_string(c.threads)};
  if (!c.memory.empty()) arguments.insert(arguments.end(), {"--memory", budget_of(c)});
  arguments.insert(arguments.end(), run.options.begin(), run.options.end());
  return arguments;
}

std::string name_of(const TilingCase& c, const TilingRun& run) {
  return "cap " + cap_of(c, run) + ", " + std::to_string(c.threads) + " threads, memory '" + c.memory + "', " +
         (c.split ? "5 files" : "1 file");
}

/// Of points or voxels; where there are both, the fewer.
std::uint64_t tiles_of(const nlohmann::json& report) {
  const auto tiles = report["tiles"]["count"].get<std::uint64_t>();
  if (!report.contains("supervoxels") || !report["supervoxels"].contains("tiles")) return tiles;
  return std::min(tiles, report["supervoxels"]["tiles"].get<std::uint64_t>());
}

}  // namespace

std::vector<TilingCase> whole_matrix() {
  std::vector<TilingCase> cases;
  for (const char* cap : {"none", "20000", "100000", "1000000"}) {
    for (const int threads : {1, 2, 4}) {
      for (const char* memory : {"", "1GiB", "256MiB"}) {
        for (const bool split : {false, true}) cases.push_back({cap, threads, memory, split});
      }
    }
  }
  return cases;
}

std::vector<TilingCase> small_matrix() {
  if (kAddressSanitizer || kThreadSanitizer) return least_matrix();
  return {{"none", 1, "", false},        {"20000", 2, "256MiB", true}, {"20000", 4, "1GiB", false},
          {"100000", 1, "256MiB", true}, {"100000", 2, "", false},     {"1000000", 4, "1GiB", true}};
}

std::vector<TilingCase> least_matrix() {
  if (kThreadSanitizer) return {{"20000", 4, "256MiB", true}, {"100000", 2, "1GiB", false}};
  if (kAddressSanitizer) return {{"none", 1, "", false}, {"20000", 4, "256MiB", true}};  // All code of the third, too.
  return {{"none", 1, "", false}, {"20000", 2, "256MiB", true}, {"100000", 4, "1GiB", false}};
}

void expect_same_bytes(const std::filesystem::path& scan, const std::vector<TilingCase>& cases, int caps_divisor,
                       const std::vector<std::string>& options) {
  expect_same_bytes(scan, cases, {"extract", options, {}, caps_divisor});
}

void expect_same_bytes(const std::filesystem::path& scan, const std::vector<TilingCase>& cases, const TilingRun& run) {
  const TempFolder folder;
  const bool ply = scan.extension() == ".ply";
  std::vector<std::filesystem::path> parts{scan};
  if (!std::filesystem::is_directory(scan))
    parts = ply ? split_ply_file(scan, 5, folder.path()) : split_las(scan, 5, folder.path());
  std::vector<std::filesystem::path> outputs{folder / (ply ? "out.ply" : "out.las")};
  for (const auto& [option, ending] : run.more_outputs) outputs.push_back(folder.path() / (option + ending));
  std::vector<std::string> expected;
  std::uint64_t most_tiles = 0;
  for (const TilingCase& c : cases) {
    const std::string what = name_of(c, run);
    std::vector<std::string> arguments = arguments_of(c, run);
    if (c.split) {
      for (const auto& part : parts) arguments.push_back(part);
    } else {
      arguments.push_back(scan);
    }
    arguments.insert(arguments.end(), {"-o", outputs[0]});
    for (std::size_t i = 1; i < outputs.size(); ++i)
      arguments.insert(arguments.end(), {run.more_outputs[i - 1].first, outputs[i]});
    arguments.insert(arguments.end(), {"--report", folder / "report.json", "--overwrite", "-q"});
    const ProcessResult result = run_arris(arguments);
    ASSERT_EQ(result.exit_code, 0) << what << "\n" << result.err;
    EXPECT_EQ(result.err, "") << what;
    const auto report = nlohmann::json::parse(file_bytes(folder / "report.json"));
    most_tiles = std::max(most_tiles, tiles_of(report));
    std::vector<std::string> bytes;
    for (const auto& output : outputs) bytes.push_back(file_bytes(output));
    if (expected.empty()) {
      expected = bytes;
      EXPECT_GT(report["points"]["out"], 100U) << "a comparison of empty outputs proves nothing";
    }
    for (std::size_t i = 0; i < outputs.size(); ++i)
      EXPECT_TRUE(bytes[i] == expected[i]) << outputs[i].filename() << " differs: " << what;
  }
  EXPECT_GT(most_tiles, 1U) << "no case was cut into tiles";
}

void synth_scan(const std::filesystem::path& path, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "synth");
  arguments.insert(arguments.end(),
                   {"-o", path, "--truth", path.string() + ".truth.csv", "--truth-of", "model", "--overwrite", "-q"});
  const ProcessResult made = run_arris(arguments);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  std::filesystem::remove(path.string() + ".truth.csv");
}

void write_spray(const std::filesystem::path& path) {
  std::vector<std::array<std::int32_t, 3>> points;
  for (std::int32_t x = 0; x < 140; ++x) {
    for (std::int32_t y = 0; y < 140; ++y) points.push_back({x * 10, y * 10, (x + y) % 3});
  }
  std::uint32_t random = 1;
  const auto next = [&] { return static_cast<std::int32_t>((random = random * 1664525U + 1013904223U) >> 20); };
  for (int i = 0; i < 250; ++i) points.push_back({next() % 1400, next() % 1400, 40 + next() % 400});
  write_las(path, points);
}

void write_duplicates(const std::filesystem::path& path) {
  std::vector<std::array<std::int32_t, 3>> points;
  std::uint32_t random = 7;
  const auto next = [&] { return static_cast<std::int32_t>((random = random * 1664525U + 1013904223U) >> 20); };
  for (std::int32_t x = -64; x < 64; ++x) {
    for (std::int32_t y = 0; y < 64; ++y) {
      points.push_back({x * 16 + next() % 8, y * 16 + next() % 8, 8 * std::abs(2 * x) + next() % 8});
    }
  }
  const std::size_t once = points.size();
  for (const std::size_t every : {2U, 3U}) {
    for (std::size_t i = 0; i < once; i += every) points.push_back(points[i]);
  }
  write_las(path, points);
}

void write_points_on_tile_faces(const std::filesystem::path& path) {
  // 3 x 3 boxes of 512 steps, sampled every 16 steps: points on every multiple of 64, 128, 256 and 512.
  std::set<std::array<std::int32_t, 3>> points;
  for (std::int32_t box_x = 0; box_x < 3; ++box_x) {
    for (std::int32_t box_y = 0; box_y < 3; ++box_y) {
      const std::int32_t height = 256 * (1 + (box_x + box_y) % 3);
      for (std::int32_t u = 0; u <= 512; u += 16) {
        for (std::int32_t v = 0; v <= 512; v += 16)
          points.insert({box_x * 1024 - 1536 + u, box_y * 1024 - 1536 + v, height});
        for (std::int32_t w = 0; w <= height; w += 16) {
          for (const std::int32_t side : {0, 512}) {
            points.insert({box_x * 1024 - 1536 + u, box_y * 1024 - 1536 + side, w});
            points.insert({box_x * 1024 - 1536 + side, box_y * 1024 - 1536 + u, w});
          }
        }
      }
    }
  }
  write_las(path, {points.begin(), points.end()});
}

}  // namespace arris::test
