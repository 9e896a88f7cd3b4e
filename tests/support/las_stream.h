#pragma once
/// @file Large LAS files, written point by point in constant memory, independent of the library under test.

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace arris::test {

/// LAS 1.2, point format 0, offset 0. The header is completed by finish().
class LasStream {
 public:
  /// @param extra_doubles  attributes "extra0", "extra1", ... of 8 bytes behind every point.
  explicit LasStream(const std::filesystem::path& path, double scale = 0.001, int extra_doubles = 0);
  void add(const std::array<std::int32_t, 3>& position);
  /// Throws std::runtime_error if anything could not be written.
  void finish();

 private:
  void flush();
  std::string header() const;

  std::filesystem::path path_;
  std::ofstream file_;
  double scale_;
  int extra_doubles_;
  std::uint32_t points_ = 0;
  std::array<std::int32_t, 3> low_{}, high_{};
  std::string buffer_;
};

}  // namespace arris::test
