#pragma once
/// @file Counts and bounds of the points written, and their place in a LAS header.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "io/bytes.h"
#include "io/las_layout.h"

namespace arris::io {

/// What the header says of all points together. Counting a point costs a few nanoseconds.
struct LasTotals {
  std::uint64_t points = 0;
  std::array<std::uint64_t, 16> by_return{};  ///< Index = return number; 0 is kept here but has no place in a header.
  std::array<std::int32_t, 3> min{kLargest, kLargest, kLargest};
  std::array<std::int32_t, 3> max{kSmallest, kSmallest, kSmallest};

  /// @param return_mask  7 for point formats 0 to 5, 15 for 6 to 10.
  void add(const std::byte* record, unsigned return_mask) {
    ++points;
    ++by_return[static_cast<unsigned>(record[14]) & return_mask];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto stored = load<std::int32_t>(record + 4 * axis);
      if (stored < min[axis]) min[axis] = stored;
      if (stored > max[axis]) max[axis] = stored;
    }
  }

 private:
  static constexpr std::int32_t kLargest = std::numeric_limits<std::int32_t>::max();
  static constexpr std::int32_t kSmallest = std::numeric_limits<std::int32_t>::min();
};

/// True if a file of that version can count so many points.
inline bool can_count(int minor, std::uint64_t points) {
  return minor >= 4 || points <= std::numeric_limits<std::uint32_t>::max();
}

/// Writes counts, counts by return and bounds into a new header, from whose version, point format, scale and offset
/// they follow. The 32-bit counts are written for point formats 0 to 5 only, and if they suffice; the bounds of no
/// points are zero.
void store_totals(std::span<std::byte> header, const LasTotals& totals);

/// The same for the header of an existing file, of which nothing that is true changes: bounds stay as they are where
/// they are true to one step of the scale, and 32-bit counts stay zero where a LAS 1.4 file has 64-bit ones alone.
void correct_totals(std::span<std::byte> header, const LasTotals& totals);

/// A LAS 1.4 header without points: scale and offset set, everything unused zero, WKT bit set.
std::array<std::byte, 375> make_las14_header(std::uint8_t point_format, std::size_t record_bytes,
                                             const std::array<double, 3>& scale, const std::array<double, 3>& offset);

}  // namespace arris::io
