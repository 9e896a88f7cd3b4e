#pragma once
/// @file PLY files of any format, order and types for tests, independent of the library under test.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace arris::test {

struct PlyColumn {
  std::string name;
  std::string type = "float";
  std::string list = "";  ///< Type of the length, or empty for a scalar.
};

/// A value in the body: one number, or the items of a list.
using PlyCell = std::vector<double>;

struct PlyTable {
  std::string name = "vertex";
  std::vector<PlyColumn> columns;
  std::vector<std::vector<PlyCell>> rows;
};

struct PlyPlan {
  std::string format = "ascii";
  std::string line_end = "\n";
  std::vector<std::string> comments;  ///< Whole lines, before the first element.
  std::vector<PlyTable> tables;
};

namespace ply_detail {

template <typename T>
std::string raw(double value, bool big) {
  T number = static_cast<T>(value);
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &number, sizeof(T));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

inline std::string binary(const std::string& type, double value, bool big) {
  if (type == "char" || type == "int8") return raw<std::int8_t>(value, big);
  if (type == "uchar" || type == "uint8") return raw<std::uint8_t>(value, big);
  if (type == "short" || type == "int16") return raw<std::int16_t>(value, big);
  if (type == "ushort" || type == "uint16") return raw<std::uint16_t>(value, big);
  if (type == "int" || type == "int32") return raw<std::int32_t>(value, big);
  if (type == "uint" || type == "uint32") return raw<std::uint32_t>(value, big);
  if (type == "float" || type == "float32") return raw<float>(value, big);
  return raw<double>(value, big);
}

inline std::string decimal(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace ply_detail

/// The bytes of one row, without the end of its line.
inline std::string ply_row(const PlyPlan& plan, const PlyTable& table, std::size_t row) {
  const bool ascii = plan.format == "ascii";
  const bool big = plan.format == "binary_big_endian";
  std::string bytes;
  const auto add = [&](const std::string& type, double value) {
    if (ascii && !bytes.empty()) bytes += ' ';
    if (ascii) bytes += ply_detail::decimal(value);
    if (!ascii) bytes += ply_detail::binary(type, value, big);
  };
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const PlyColumn& column = table.columns[i];
    const PlyCell& cell = table.rows[row][i];
    if (!column.list.empty()) add(column.list, static_cast<double>(cell.size()));
    for (const double value : cell) add(column.type, value);
  }
  return bytes;
}

inline std::string build_ply(const PlyPlan& plan) {
  std::string text = "ply" + plan.line_end + "format " + plan.format + " 1.0" + plan.line_end;
  for (const std::string& line : plan.comments) text += line + plan.line_end;
  for (const PlyTable& table : plan.tables) {
    text += "element " + table.name + " " + std::to_string(table.rows.size()) + plan.line_end;
    for (const PlyColumn& c : table.columns) {
      text += "property " + (c.list.empty() ? "" : "list " + c.list + " ") + c.type + " " + c.name + plan.line_end;
    }
  }
  text += "end_header" + plan.line_end;
  for (const PlyTable& table : plan.tables) {
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      text += ply_row(plan, table, i) + (plan.format == "ascii" ? plan.line_end : "");
    }
  }
  return text;
}

/// A table of vertices with the columns given; x, y, z among them get 1.5 i, -i, i / 4, others 7 i mod 100, lists i mod
/// 4 items.
inline PlyTable make_vertices(const std::vector<PlyColumn>& columns, std::size_t count) {
  PlyTable table{"vertex", columns, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const double n = static_cast<double>(i);
    std::vector<PlyCell> row;
    for (const PlyColumn& column : columns) {
      if (!column.list.empty()) {
        row.emplace_back(i % 4, static_cast<double>(i % 100));
      } else {
        row.push_back({column.name == "x"   ? 1.5 * n
                       : column.name == "y" ? -n
                       : column.name == "z" ? n / 4
                                            : static_cast<double>(7 * i % 100)});
      }
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace arris::test
