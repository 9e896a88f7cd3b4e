#pragma once
/// @file Pieces of PLY files that several writers make.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/columns.h"
#include "io/ply_header.h"

namespace arris::io {

/// "element vertex <count>" preceded by a comment, together of the same length whatever the count: written first with
/// 0, patched when the count is known. Padding the number itself would confuse some readers.
std::string ply_count_lines(std::uint64_t count, std::string_view line_end);
/// True for the comment of ply_count_lines(), which is not carried on.
bool is_count_comment(std::string_view line);

/// "property <type> <name>" lines of our columns.
std::string ply_column_lines(const std::vector<ColumnSpec>& columns, std::string_view line_end);

/// Begins the comment that names the coordinate reference system of points that came from LAS.
inline constexpr std::string_view kPlyCrsComment = "comment crs ";

/// Appends one value in the file's format, integers rounded; in ascii all but the first of a line are preceded by a
/// blank.
void encode_value(PlyFormat format, ScalarType type, double value, std::vector<std::byte>& out);

/// Appends one row of our columns in the file's format; in ascii each value is preceded by a blank. Numbers are printed
/// with the fewest digits that give the same value back.
void encode_row(PlyFormat format, const std::vector<ColumnSpec>& columns, const std::byte* row,
                std::vector<std::byte>& out);

}  // namespace arris::io
