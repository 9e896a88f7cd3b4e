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
  last_.reserve(offset);
  row_bytes_ = offset;
}

bool ColumnRanges::same_row(const std::byte* row) const {
  std::uint32_t label;
  if (row_bytes_ != sizeof(label)) return std::memcmp(row, last_.data(), row_bytes_) == 0;
  std::uint32_t last;  // A row of one label, without a call.
  std::memcpy(&label, row, sizeof(label));
  std::memcpy(&last, last_.data(), sizeof(last));
  return label == last;
}

void ColumnRanges::add(const std::byte* row) {
  if (!last_.empty() && same_row(row)) return;
  last_.assign(row, row + row_bytes_);
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
