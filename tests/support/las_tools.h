#pragma once
/// @file A second, minimal reading of LAS, independent of the library under test.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace arris::test {

std::string file_bytes(const std::filesystem::path& path);
void write_bytes(const std::filesystem::path& path, const std::string& bytes);

/// The header fields a test needs, and the records.
struct LasView {
  std::uint64_t points = 0;
  std::size_t record_bytes = 0;
  std::size_t offset_to_points = 0;
  std::array<double, 3> scale{};
  std::array<double, 3> offset{};
  std::string bytes;
  const char* record(std::uint64_t i) const { return bytes.data() + offset_to_points + i * record_bytes; }
  std::array<std::int32_t, 3> position(std::uint64_t i) const;
};
LasView view_las(const std::filesystem::path& path);

/// Cuts a LAS file into `parts` files of consecutive points with the same header and VLRs (EVLRs dropped); returns
/// their paths.
std::vector<std::filesystem::path> split_las(const std::filesystem::path& path, int parts,
                                             const std::filesystem::path& folder);

/// Writes LAS 1.2, point format 0, from integers.
void write_las(const std::filesystem::path& path, const std::vector<std::array<std::int32_t, 3>>& points,
               double scale = 0.001, std::array<double, 3> offset = {0, 0, 0});

}  // namespace arris::test
