#pragma once
/// @file The layout of a LAS output whose inputs are PLY or have different layouts, and its records.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/column_union.h"
#include "io/kept_writers.h"
#include "io/las_fields.h"

namespace arris::io {

/// Decides the layout and fills records from values. Point formats 0 to 3 if all inputs have one of these, else 6, 7
/// with colour, 8 with near infrared too: always one that holds the fields of every input, without waveforms.
class LasConversion {
 public:
  LasConversion(const KeptJob& job, const ColumnUnion& columns);

  std::uint8_t point_format() const { return point_format_; }
  /// Record length without our columns.
  std::size_t record_bytes() const { return record_bytes_; }
  /// Extra-bytes entries of the inputs' attributes.
  const std::vector<std::byte>& entries() const { return entries_; }
  /// Names of the attributes in the extra bytes.
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// True if the inputs' extra bytes are all alike and copied as they are.
  bool copies_extra_bytes() const { return verbatim_bytes_ > 0; }

  /// Fills a zeroed record, apart from its coordinates.
  /// @param values  of ColumnUnion::map(). @param original  the record they came from.
  void fill(std::size_t input, std::span<const double> values, std::span<const std::byte> original, std::byte* record);

  /// One line per field in which values were cut to what it holds.
  std::vector<std::string> clamped() const;

 private:
  struct Stored {
    LasField field;
    std::size_t column;
    std::uint64_t clamped = 0;
  };
  struct Extra {
    ScalarType type;
    std::size_t offset;
    std::size_t column;
  };
  void choose_format(const std::vector<SourceInfo>& inputs);
  bool is_field(std::string_view name) const;
  void add_extras();

  const ColumnUnion& columns_;
  std::uint8_t point_format_ = 6;
  std::vector<Stored> fields_;
  std::vector<Extra> extras_;
  std::vector<std::size_t> input_record_bytes_;
  std::size_t verbatim_bytes_ = 0;  ///< Extra bytes that all inputs share are copied as they are.
  int number_column_ = -1;          ///< return_number
  int returns_column_ = -1;         ///< number_of_returns
  std::size_t record_bytes_ = 0;
  std::vector<std::byte> entries_;
  std::vector<std::string> names_;
  std::vector<std::string> warnings_;
};

}  // namespace arris::io
