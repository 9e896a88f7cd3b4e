#pragma once
/// @file What a scan file says of itself, for people and reports: more than reading points needs.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/las_crs.h"
#include "io/point_source.h"
#include "io/point_writer.h"

namespace arris::io {

/// A LAS variable-length record, or a PLY element other than the vertices (then only name and length).
struct RecordSummary {
  std::string user_id;  ///< PLY: name of the element.
  std::uint16_t record_id = 0;
  std::string description;
  std::uint64_t length = 0;  ///< Payload bytes; PLY: number of records.
  bool extended = false;     ///< Behind the points (EVLR).
};

/// An attribute of the points: LAS extra bytes, or a PLY vertex property.
struct AttributeSummary {
  std::string name;
  std::string type;  ///< "uint8", "float[3]", "undocumented"; PLY: "uchar", "list uchar int", ...
  std::string description;
  std::size_t size_bytes = 0;  ///< Per point; 0 for lists and ascii.
};

/// All texts are printable and bounded.
struct FileSummary {
  SourceInfo info;
  std::vector<std::pair<std::string, std::string>> header;  ///< Fields in the order of the file.
  std::optional<WorldExtent> claimed_bounds;                ///< As the header has it, possibly wrong; PLY has none.
  std::vector<RecordSummary> records;
  std::vector<AttributeSummary> attributes;
  CrsSummary crs;
  std::vector<Problem> problems;
};

/// Reads the structure of a file, no points (PLY files whose vertices lie behind lists are read up to the vertices).
/// Throws InputError / IoError as open_point_source() does.
FileSummary summarize_file(std::shared_ptr<const InputFile> file, Tolerance tolerance = Tolerance::kUsual);
FileSummary summarize_file(const std::filesystem::path& path, Tolerance tolerance = Tolerance::kUsual);

}  // namespace arris::io
