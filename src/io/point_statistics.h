#pragma once
/// @file What all points of a file show together: extent and range of every attribute.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "io/point_source.h"
#include "io/point_writer.h"
#include "io/record_reader.h"

namespace arris::io {

struct ColumnStatistics {
  RecordColumn column;
  double min = 0.0;  ///< Of the finite values; 0 where there are none.
  double max = 0.0;
  std::uint64_t finite = 0;
  std::uint64_t not_finite = 0;
};

struct PointStatistics {
  std::uint64_t points = 0;
  std::uint64_t without_position = 0;  ///< NaN or infinite coordinates.
  WorldExtent extent;                  ///< Of the others.
  std::vector<ColumnStatistics> columns;
  std::array<std::uint64_t, 256> classes{};   ///< Points by classification; all 0 if there is none.
  std::array<std::uint64_t, 16> by_return{};  ///< Points by return number, likewise.
  std::uint64_t odd_returns = 0;              ///< Return number 0, or above the number of returns.

  const ColumnStatistics* find(std::string_view name) const;
  /// Red, green and blue are stored in 16 bits but none exceeds 255: they were written with 8.
  bool has_8_bit_colours() const;
};

/// Reads all points from the start. Linear time, memory of one batch.
/// @param read  called with the number of points after each batch; may throw to stop.
PointStatistics collect_statistics(PointSource& source, RecordReader& reader,
                                   const std::function<void(std::uint64_t)>& read);

/// What the points show to be wrong in the header (bounds, counts by return) or odd in themselves.
std::vector<Problem> find_point_problems(const InputFile& file, const SourceInfo& info,
                                         const PointStatistics& statistics);

}  // namespace arris::io
