#pragma once
/// @file Pieces of sound PLY files to damage.

#include <cstdint>
#include <string>

#include "io/ply_builder.h"

namespace arris::test {

inline constexpr std::uint64_t kSoundVertices = 3;
inline const std::string kPlyStart = "ply\nformat ascii 1.0\n";
inline const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
inline const std::string kVertices = "element vertex 3\n" + kXyz;
inline const std::string kEnd = "end_header\n";
inline const std::string kAsciiBody = "0 0 0\n1 1 1\n2 2 2\n";

inline const std::string kPlyFormats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
/// For names of cases: "ascii", "little", "big".
inline std::string short_name(const std::string& format) {
  return format == "ascii" ? format : format == "binary_little_endian" ? "little" : "big";
}

inline std::string ply_start(const std::string& format) {
  return "ply\nformat " + format + " 1.0\n";
}

/// `count` vertices of three floats, in the format's encoding.
inline std::string xyz_body(const std::string& format, std::uint64_t count) {
  const PlyPlan plan{format, "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}}, count)}};
  std::string body;
  for (std::uint64_t i = 0; i < count; ++i) body += ply_row(plan, plan.tables[0], i) + (format == "ascii" ? "\n" : "");
  return body;
}

}  // namespace arris::test
