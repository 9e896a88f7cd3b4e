#include "io/ply_output.h"

#include <fmt/format.h>

#include <iterator>

#include "io/bytes.h"

namespace arris::io {
namespace {

constexpr std::string_view kCountComment = "comment written by arris .";

const char* column_type_name(ColumnType type) {
  switch (type) {
    case ColumnType::kUint8:
      return "uchar";
    case ColumnType::kUint16:
      return "ushort";
    case ColumnType::kUint32:
      return "uint";
    case ColumnType::kFloat32:
      break;
  }
  return "float";
}

void print_value(ColumnType type, const std::byte* at, std::vector<std::byte>& out) {
  std::array<char, 48> text{};
  char* end = text.data();
  switch (type) {
    case ColumnType::kUint8:
      end = fmt::format_to(text.data(), " {}", load<std::uint8_t>(at));
      break;
    case ColumnType::kUint16:
      end = fmt::format_to(text.data(), " {}", load<std::uint16_t>(at));
      break;
    case ColumnType::kUint32:
      end = fmt::format_to(text.data(), " {}", load<std::uint32_t>(at));
      break;
    case ColumnType::kFloat32:
      end = fmt::format_to(text.data(), " {}", load<float>(at));
      break;
  }
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  out.insert(out.end(), first, first + (end - text.data()));
}

}  // namespace

std::string ply_count_lines(std::uint64_t count, std::string_view line_end) {
  const std::string digits = fmt::format("{}", count);
  return fmt::format("{}{}{}element vertex {}{}", kCountComment, std::string(20 - digits.size(), '.'), line_end, digits,
                     line_end);
}

bool is_count_comment(std::string_view line) {
  return line.starts_with(kCountComment);
}

std::string ply_column_lines(const std::vector<ColumnSpec>& columns, std::string_view line_end) {
  std::string lines;
  for (const ColumnSpec& column : columns) {
    lines += fmt::format("property {} {}{}", column_type_name(column.type), column.name, line_end);
  }
  return lines;
}

void encode_value(PlyFormat format, ScalarType type, double value, std::vector<std::byte>& out) {
  std::array<std::byte, 8> bytes{};
  store_scalar(type, value, bytes.data());
  const std::size_t size = size_bytes(type);
  if (format == PlyFormat::kLittleEndian) {
    out.insert(out.end(), bytes.data(), bytes.data() + size);
  } else if (format == PlyFormat::kBigEndian) {
    out.insert(out.end(), std::reverse_iterator(bytes.data() + size), std::reverse_iterator(bytes.data()));
  } else {
    std::string text = out.empty() ? "" : " ";
    if (type == ScalarType::kFloat32) {
      text += fmt::format("{}", static_cast<float>(value));
    } else if (type == ScalarType::kFloat64) {
      text += fmt::format("{}", value);
    } else if (type == ScalarType::kUint64) {
      text += fmt::format("{}", load<std::uint64_t>(bytes.data()));
    } else if (type == ScalarType::kInt64) {
      text += fmt::format("{}", load<std::int64_t>(bytes.data()));
    } else {
      text += fmt::format("{:.0f}", load_scalar(type, bytes.data()));
    }
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    out.insert(out.end(), first, first + text.size());
  }
}

void encode_row(PlyFormat format, const std::vector<ColumnSpec>& columns, const std::byte* row,
                std::vector<std::byte>& out) {
  for (const ColumnSpec& column : columns) {
    const std::size_t size = size_bytes(column.type);
    if (format == PlyFormat::kAscii) {
      print_value(column.type, row, out);
    } else if (format == PlyFormat::kLittleEndian) {
      out.insert(out.end(), row, row + size);
    } else {
      out.insert(out.end(), std::reverse_iterator(row + size), std::reverse_iterator(row));
    }
    row += size;
  }
}

}  // namespace arris::io
