#include "io/column_ranges.h"

#include <array>
#include <cmath>
#include <cstring>

#include "io/bytes.h"
#include "io/las_extra_bytes.h"
#include "io/scalar_type.h"

namespace arris::io {
namespace {

/// Places in a 192-byte entry, and the option bits that say they are filled.
constexpr std::size_t kOptions = 3, kMin = 64, kMax = 88;
constexpr std::uint8_t kHasMin = 2, kHasMax = 4;

/// "Anytype": eight bytes, integers as 64-bit ones, floats as doubles.
std::array<std::byte, 8> any_type(ColumnType type, double value) {
  std::array<std::byte, 8> bytes{};
  const bool real = type == ColumnType::kFloat32;
  store_scalar(real ? ScalarType::kFloat64 : ScalarType::kUint64, value, bytes.data());
  return bytes;
}

}  // namespace

ColumnRanges::ColumnRanges(const std::vector<ColumnSpec>& columns) {
  std::size_t offset = 0;
  for (const ColumnSpec& column : columns) {
    ranges_.push_back({column.type, offset});
    offset += size_bytes(column.type);
  }
  last_.resize(offset);
}

void ColumnRanges::add(std::span<const std::byte> rows) {
  const std::size_t row_bytes = last_.size();
  for (std::size_t at = 0; at < rows.size(); at += row_bytes) {
    const std::byte* const row = rows.data() + at;
    if (any_ && same_row(row)) continue;
    std::memcpy(last_.data(), row, row_bytes);
    any_ = true;
    add_row(row);
  }
}

bool ColumnRanges::same_row(const std::byte* row) const {
  if (last_.size() != sizeof(std::uint32_t)) return std::memcmp(row, last_.data(), last_.size()) == 0;
  return load<std::uint32_t>(row) == load<std::uint32_t>(last_.data());  // One label, without a call.
}

void ColumnRanges::add_row(const std::byte* row) {
  for (Range& range : ranges_) {
    const double value = load_scalar(scalar_type(range.type), row + range.offset);
    if (std::isnan(value)) continue;
    if (!range.any || value < range.min) range.min = value;
    if (!range.any || value > range.max) range.max = value;
    range.any = true;
  }
}

void ColumnRanges::patch_entries(OutputFile& output, std::uint64_t offset) const {
  for (const Range& range : ranges_) {
    if (range.any) {
      const std::byte options{kHasMin | kHasMax};
      output.patch(offset + kOptions, {&options, 1});
      output.patch(offset + kMin, any_type(range.type, range.min));
      output.patch(offset + kMax, any_type(range.type, range.max));
    }
    offset += kExtraBytesEntryBytes;
  }
}

}  // namespace arris::io
