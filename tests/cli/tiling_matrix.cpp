#include "tiling_matrix.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <set>

#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/sanitizers.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

// AddressSanitizer's own memory counts as resident.
const std::string kSmallBudget = kAddressSanitizer ? "768MiB" : "256MiB";

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
  return {{"none", 1, "", false}, {"20000", 2, "256MiB", true}, {"100000", 4, "1GiB", false}};
}

void expect_same_bytes(const std::filesystem::path& scan, const std::vector<TilingCase>& cases, int caps_divisor,
                       const std::vector<std::string>& options) {
  const TempFolder folder;
  std::vector<std::filesystem::path> parts{scan};
  if (!std::filesystem::is_directory(scan)) parts = split_las(scan, 5, folder.path());
  std::string expected;
  for (const TilingCase& c : cases) {
    const std::string out = folder / "out.las";
    const std::string cap =
        c.tile_points == "none" ? c.tile_points : std::to_string(std::stoi(c.tile_points) / caps_divisor);
    std::vector<std::string> arguments{"extract", "--tile-points", cap, "--threads", std::to_string(c.threads)};
    if (!c.memory.empty())
      arguments.insert(arguments.end(), {"--memory", c.memory == "256MiB" ? kSmallBudget : c.memory});
    if (c.split) {
      for (const auto& part : parts) arguments.push_back(part);
    } else {
      arguments.push_back(scan);
    }
    arguments.insert(arguments.end(), {"-o", out, "--overwrite", "-q"});
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProcessResult run = run_arris(arguments);
    const std::string what = "cap " + cap + ", " + std::to_string(c.threads) + " threads, memory '" + c.memory + "', " +
                             (c.split ? "5 files" : "1 file");
    ASSERT_EQ(run.exit_code, 0) << what << "\n" << run.err;
    EXPECT_EQ(run.err, "") << what;
    const std::string bytes = file_bytes(out);
    if (expected.empty()) {
      expected = bytes;
      const LasView view = view_las(out);
      EXPECT_GT(view.points, 100U) << "a comparison of empty outputs proves nothing";
    }
    EXPECT_TRUE(bytes == expected) << "output differs: " << what;
  }
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
