#pragma once
/// @file The table of verdicts (verdicts.csv): what make_verdicts.py, an independent reader, says of every real scan.

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace arris::test {

struct Verdict {
  std::string path;  ///< Relative to the folder of shared data.
  bool read = false;
  std::string error;  ///< Class of the refusal; empty if read.
  std::string format;
  std::uint64_t promised = 0;
  /// Whole points that are there. Like everything below, also set for files that break off.
  std::uint64_t count = 0;
  std::array<std::string, 3> sums;  ///< LAS: exact sums of the stored integers. PLY: rounded sums of finite doubles.
  bool has_extent = false;
  std::array<double, 3> min{};
  std::array<double, 3> max{};
  std::string intensity;  ///< Sums, or empty where the file lacks the attribute.
  std::string red;
  std::string digest;  ///< See digest() in values.py.
  std::set<std::string> problems;
  /// Header fields of a LAS file that contradict its points, and what a copy of all points must hold instead.
  std::map<std::string, std::string> wrong_fields;

  bool is_las() const { return format.starts_with("LAS"); }
  bool has_points() const { return !format.empty(); }
};

/// Throws std::runtime_error if the table cannot be read.
std::vector<Verdict> load_verdicts();

/// Name of a parameterised test.
std::string test_name(const Verdict& verdict, std::size_t index);

void PrintTo(const Verdict& verdict, std::ostream* out);

}  // namespace arris::test
