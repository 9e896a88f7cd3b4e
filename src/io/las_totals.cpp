#include "io/las_totals.h"

#include <algorithm>
#include <cmath>

namespace arris::io {

namespace {

struct Bounds {
  double min = 0.0;
  double max = 0.0;
};

Bounds bounds_of(std::span<const std::byte> header, const LasTotals& totals, std::size_t axis) {
  if (totals.points == 0) return {};
  const auto scale = load<double>(&header[kScale + 8 * axis]);
  const auto offset = load<double>(&header[kOffset + 8 * axis]);
  const double a = las_world(scale, offset, totals.min[axis]);
  const double b = las_world(scale, offset, totals.max[axis]);
  return {std::min(a, b), std::max(a, b)};
}

void store_counts(std::span<std::byte> header, const LasTotals& totals, bool legacy) {
  store<std::uint32_t>(&header[kLegacyCount], legacy ? static_cast<std::uint32_t>(totals.points) : 0);
  for (std::size_t i = 0; i < 5; ++i) {
    const std::uint64_t count = legacy ? totals.by_return[i + 1] : 0;
    store<std::uint32_t>(&header[kLegacyByReturn + 4 * i], static_cast<std::uint32_t>(count));
  }
  if (load<std::uint8_t>(&header[kVersionMinor]) < 4) return;
  store<std::uint64_t>(&header[kPointCount], totals.points);
  for (std::size_t i = 0; i < 15; ++i) {
    store<std::uint64_t>(&header[kPointsByReturn + 8 * i], totals.by_return[i + 1]);
  }
}

bool may_count_in_32_bits(std::span<const std::byte> header, const LasTotals& totals) {
  const bool extended = is_extended_format(load<std::uint8_t>(&header[kPointFormat]));
  return !(load<std::uint8_t>(&header[kVersionMinor]) >= 4 && extended) &&
         totals.points <= std::numeric_limits<std::uint32_t>::max();
}

}  // namespace

void store_totals(std::span<std::byte> header, const LasTotals& totals) {
  store_counts(header, totals, may_count_in_32_bits(header, totals));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Bounds bounds = bounds_of(header, totals, axis);
    store<double>(&header[kBounds + 16 * axis], bounds.max);
    store<double>(&header[kBounds + 16 * axis + 8], bounds.min);
  }
}

void correct_totals(std::span<std::byte> header, const LasTotals& totals) {
  const bool only_64_bits = load<std::uint8_t>(&header[kVersionMinor]) >= 4 &&
                            load<std::uint32_t>(&header[kLegacyCount]) == 0 &&
                            load<std::uint64_t>(&header[kPointCount]) != 0;
  store_counts(header, totals, may_count_in_32_bits(header, totals) && !only_64_bits);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Bounds bounds = bounds_of(header, totals, axis);
    const double step = totals.points == 0 ? 0.0 : std::abs(load<double>(&header[kScale + 8 * axis]));
    const auto correct = [&](std::size_t field, double truth) {
      if (!(std::abs(load<double>(&header[field]) - truth) <= step)) store<double>(&header[field], truth);
    };
    correct(kBounds + 16 * axis, bounds.max);
    correct(kBounds + 16 * axis + 8, bounds.min);
  }
}

std::array<std::byte, 375> make_las14_header(std::uint8_t point_format, std::size_t record_bytes,
                                             const std::array<double, 3>& scale, const std::array<double, 3>& offset) {
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
    store<double>(raw + kScale + 8 * axis, scale[axis]);
    store<double>(raw + kOffset + 8 * axis, offset[axis]);
  }
  return header;
}

}  // namespace arris::io
