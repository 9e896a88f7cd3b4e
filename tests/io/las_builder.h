#pragma once
/// @file LAS files byte by byte for tests, and a second reading of them; both independent of the library under test.

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace arris::test {

inline constexpr std::array<std::size_t, 11> kFormatBytes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
inline constexpr std::array<std::size_t, 6> kHeaderBytes{227, 227, 227, 235, 375, 393};

template <typename T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}
template <typename T>
T get(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

struct TestVlr {
  std::string user = "test";
  std::uint16_t id = 1;
  std::string payload;
  std::string description = "a record";
};

/// What to build. Points are whole records; their length is taken from record_bytes.
struct LasPlan {
  int minor = 2;
  int format = 0;
  std::size_t record_bytes = 20;
  std::size_t header_padding = 0;
  std::vector<TestVlr> vlrs{};
  std::string gap{};
  std::vector<std::string> points{};
  std::vector<TestVlr> evlrs{};
  std::array<double, 3> scale{0.01, 0.01, 0.001};
  std::array<double, 3> offset{500000.0, 5000000.0, -10.0};
};

/// `points` records of make_records(), each `extra` bytes longer than the format.
LasPlan plan_of(int minor, int format, std::size_t points, std::size_t extra = 0);
std::string build_las(const LasPlan& plan);
/// `count` records of deterministic, different bytes.
std::vector<std::string> make_records(std::size_t count, std::size_t record_bytes, unsigned seed = 1);
/// One 192-byte entry of an extra-bytes record.
std::string extra_entry(int type, const std::string& name, int options = 0);

/// A second reading: places of all parts by the specification.
struct LasParts {
  int minor = 0;
  int format = 0;
  std::size_t header_bytes = 0;
  std::size_t record_bytes = 0;
  std::uint64_t points = 0;
  std::uint64_t legacy_points = 0;
  std::vector<std::uint64_t> by_return{};
  std::array<double, 3> min{}, max{};
  std::vector<TestVlr> vlrs{};
  std::string gap{};
  std::vector<std::string> records{};
  std::vector<TestVlr> evlrs{};
  std::uint64_t waveform_start = 0;
};
LasParts read_parts(const std::string& bytes);

}  // namespace arris::test
