#pragma once
/// @file The columns in which contours are written.

#include <cstddef>
#include <cstring>
#include <vector>

#include "core/columns.h"
#include "features/contour/contour_record.h"

namespace arris::pipeline {

/// EdgeClass, EdgeScore, FoldAngle; refined: also EdgeX, EdgeY, EdgeZ, the way from the point to the nearest point of
/// the refined edge, data units.
std::vector<ColumnSpec> contour_columns(bool refined);

/// Appends the bytes of a value.
template <class T>
void append_value(std::vector<std::byte>& rows, const T& value) {
  const std::size_t at = rows.size();
  rows.resize(at + sizeof value);
  std::memcpy(&rows[at], &value, sizeof value);
}

/// One row of contour_columns(), packed.
void append_contour_row(std::vector<std::byte>& rows, const ContourRecord& record, bool refined);

}  // namespace arris::pipeline
