#pragma once
/// @file Least and greatest values of our columns, as their extra-bytes descriptions state them (LAS 1.4 R15, table
/// 25).

#include <cstddef>
#include <span>
#include <vector>

#include "core/columns.h"
#include "io/output_file.h"

namespace arris::io {

class ColumnRanges {
 public:
  explicit ColumnRanges(const std::vector<ColumnSpec>& columns);
  /// Rows of the columns, one after the other. NaN has no place in a range.
  void add(std::span<const std::byte> rows);
  /// Completes the entries of the columns, which were written at `offset` in this order. Nothing where no row was
  /// added.
  void patch_entries(OutputFile& output, std::uint64_t offset) const;

 private:
  bool same_row(const std::byte* row) const;
  void add_row(const std::byte* row);
  struct Range {
    ColumnType type;
    std::size_t offset;  ///< In the row.
    double min = 0.0;
    double max = 0.0;
    bool any = false;
  };
  std::vector<Range> ranges_;
  std::vector<std::byte> last_;  ///< The row before: labels of neighbours are mostly the same.
  bool any_ = false;             ///< There was one.
};

}  // namespace arris::io
