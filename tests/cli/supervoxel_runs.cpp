#include "supervoxel_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace arris::test {

void label(const std::filesystem::path& input, const std::filesystem::path& output,
           const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"supervoxel", input, "-o", output, "--overwrite", "-q"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProcessResult run = run_arris(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
}

std::vector<std::uint32_t> labels_of(const LasView& view) {
  std::vector<std::uint32_t> labels(view.points);
  for (std::uint64_t i = 0; i < view.points; ++i)
    std::memcpy(&labels[i], view.record(i) + view.record_bytes - sizeof(std::uint32_t), sizeof(std::uint32_t));
  return labels;
}

std::uint32_t expect_dense(const std::vector<std::uint32_t>& labels, std::size_t zeros) {
  std::vector<std::uint32_t> sorted = labels;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::count(sorted.begin(), sorted.end(), 0U), static_cast<std::ptrdiff_t>(zeros));
  sorted.erase(sorted.begin(), std::upper_bound(sorted.begin(), sorted.end(), 0U));
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    EXPECT_EQ(sorted[i], i + 1) << "ids are not dense";
    if (sorted[i] != i + 1) break;
  }
  return static_cast<std::uint32_t>(sorted.size());
}

std::vector<std::vector<std::string>> csv_of(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(file_bytes(path));
  for (std::string line; std::getline(lines, line);) {
    auto& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

std::vector<std::array<std::int32_t, 3>> noisy_plate(int n, std::int32_t spacing) {
  std::vector<std::array<std::int32_t, 3>> points;
  std::uint32_t random = 3;
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t j = 0; j < n; ++j) {
      random = random * 1664525U + 1013904223U;
      points.push_back({i * spacing, j * spacing, static_cast<std::int32_t>(random >> 29) % spacing / 4});
    }
  }
  return points;
}

}  // namespace arris::test
