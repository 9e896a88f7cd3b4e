#pragma once
/// @file The header of a PLY file (Turk 1994, and the dialects in use): elements, properties, and the lines as they
/// were.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_file.h"
#include "io/point_source.h"
#include "io/scalar_type.h"

namespace arris::io {

enum class PlyFormat : std::uint8_t { kAscii, kLittleEndian, kBigEndian };

/// "ascii", "binary_little_endian", "binary_big_endian"
const char* format_name(PlyFormat format);

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat32;  ///< Of the value, or of each item of a list.
  bool is_list = false;
  ScalarType count_type = ScalarType::kUint8;  ///< Of a list's length; always an integer type.

  friend bool operator==(const PlyProperty&, const PlyProperty&) = default;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  std::size_t line = 0;  ///< Index of its "element" line.

  bool has_list() const;
  /// Bytes of one record if it has no list; otherwise the least bytes (empty lists). Binary formats only.
  std::size_t least_bytes() const;
  /// Index of a scalar property, or -1.
  int find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::string version;             ///< "1.0"
  std::string line_end;            ///< "\n", "\r\n" or "\r"
  std::vector<std::string> lines;  ///< All lines, "ply" to "end_header", without their ends.
  std::vector<PlyElement> elements;
  std::size_t vertex = 0;        ///< Index of the vertex element.
  std::uint64_t body_begin = 0;  ///< Offset in the file of the first byte behind the header.
  std::vector<Problem> problems;

  const PlyElement& vertices() const { return elements[vertex]; }
  const char* format_name() const { return io::format_name(format); }
};

/// Reads and checks a header of at most 1 MiB (thus fewer than 65 536 properties) and 200 000 lines, in linear time.
/// Accepted: LF, CRLF and CR line ends (CR in binary files too: then the body begins right behind it), comments and
/// obj_info anywhere, leading and trailing blanks, all 16 type names and int64/uint64, and before the first element
/// lines of unknown keywords, which become comments. Throws InputError that names the line, for anything else, for
/// files without a vertex element with scalar x, y, z, and for property names that occur twice in one element.
PlyHeader read_ply_header(const InputFile& file);

}  // namespace arris::io
