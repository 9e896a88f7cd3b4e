#include "io/las_totals.h"

#include <algorithm>

namespace arris::io {

void store_totals(std::span<std::byte> header, const LasTotals& totals) {
  std::byte* raw = header.data();
  const int minor = static_cast<int>(raw[kVersionMinor]);
  const bool extended = is_extended_format(static_cast<std::uint8_t>(raw[kPointFormat]));
  const bool legacy = !(minor >= 4 && extended) && totals.points <= std::numeric_limits<std::uint32_t>::max();
  store<std::uint32_t>(raw + kLegacyCount, legacy ? static_cast<std::uint32_t>(totals.points) : 0);
  for (std::size_t i = 0; i < 5; ++i) {
    const std::uint64_t count = legacy ? totals.by_return[i + 1] : 0;
    store<std::uint32_t>(raw + kLegacyByReturn + 4 * i, static_cast<std::uint32_t>(count));
  }
  if (minor >= 4) {
    store<std::uint64_t>(raw + kPointCount, totals.points);
    for (std::size_t i = 0; i < 15; ++i) store<std::uint64_t>(raw + kPointsByReturn + 8 * i, totals.by_return[i + 1]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto scale = load<double>(raw + kScale + 8 * axis);
    const auto offset = load<double>(raw + kOffset + 8 * axis);
    const double a = totals.points == 0 ? 0.0 : las_world(scale, offset, totals.min[axis]);
    const double b = totals.points == 0 ? 0.0 : las_world(scale, offset, totals.max[axis]);
    store<double>(raw + kBounds + 16 * axis, std::max(a, b));
    store<double>(raw + kBounds + 16 * axis + 8, std::min(a, b));
  }
}

std::array<std::byte, 375> make_las14_header(std::uint8_t point_format, std::size_t record_bytes, double scale,
                                             const std::array<double, 3>& offset) {
  std::array<std::byte, 375> header{};
  std::byte* raw = header.data();
  store_text(raw, 4, "LASF");
  store<std::uint16_t>(raw + kGlobalEncoding, kEncodingWkt);
  raw[kVersionMajor] = std::byte{1};
  raw[kVersionMinor] = std::byte{4};
  store<std::uint16_t>(raw + kHeaderSize, static_cast<std::uint16_t>(header.size()));
  store<std::uint32_t>(raw + kOffsetToPoints, static_cast<std::uint32_t>(header.size()));
  raw[kPointFormat] = static_cast<std::byte>(point_format);
  store<std::uint16_t>(raw + kRecordLength, static_cast<std::uint16_t>(record_bytes));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    store<double>(raw + kScale + 8 * axis, scale);
    store<double>(raw + kOffset + 8 * axis, offset[axis]);
  }
  return header;
}

}  // namespace arris::io
