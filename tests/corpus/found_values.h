#pragma once
/// @file What arris finds in a scan, in the terms of the table of verdicts.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "io/point_source.h"

namespace arris::test {

struct FoundValues {
  std::uint64_t count = 0;
  std::array<long double, 3> sums{};      ///< Of finite coordinates. Stored integers of LAS: exact below 2^63.
  std::array<long double, 3> absolute{};  ///< Sums of absolute values: the scale of rounding.
  std::array<double, 3> min;
  std::array<double, 3> max;
  std::optional<long double> intensity;
  std::optional<long double> red;
  std::uint64_t digest = 0;
  std::string records;  ///< All raw records, one after the other.

  FoundValues() {
    min.fill(std::numeric_limits<double>::infinity());
    max.fill(-std::numeric_limits<double>::infinity());
  }
};

/// Reads all points of `source`.
FoundValues find_values(io::PointSource& source);

}  // namespace arris::test
