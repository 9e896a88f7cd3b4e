#pragma once
/// @file A second, minimal reading of binary little-endian PLY vertices without lists, independent of the library.

#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace arris::test {

struct PlyView {
  std::vector<std::string> header;  ///< Lines.
  std::vector<std::string> names;   ///< In the order of the file.
  std::map<std::string, std::string> types;
  std::vector<std::map<std::string, double>> vertices;
};

namespace ply_view_detail {
template <typename T>
double take(const std::string& bytes, std::size_t& at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  at += sizeof value;
  return static_cast<double>(value);
}
inline double take_type(const std::string& type, const std::string& bytes, std::size_t& at) {
  if (type == "char") return take<std::int8_t>(bytes, at);
  if (type == "uchar") return take<std::uint8_t>(bytes, at);
  if (type == "short") return take<std::int16_t>(bytes, at);
  if (type == "ushort") return take<std::uint16_t>(bytes, at);
  if (type == "int") return take<std::int32_t>(bytes, at);
  if (type == "uint") return take<std::uint32_t>(bytes, at);
  if (type == "float") return take<float>(bytes, at);
  return take<double>(bytes, at);
}
}  // namespace ply_view_detail

inline PlyView view_ply(const std::string& bytes) {
  PlyView view;
  std::istringstream lines(bytes);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line) && line != "end_header";) {
    view.header.push_back(line);
    std::istringstream words(line);
    std::string keyword, first, second;
    words >> keyword >> first >> second;
    if (keyword == "element") count = std::stoul(second);
    if (keyword != "property") continue;
    view.names.push_back(second);
    view.types[second] = first;
  }
  std::size_t at = static_cast<std::size_t>(lines.tellg());
  for (std::size_t i = 0; i < count; ++i) {
    auto& vertex = view.vertices.emplace_back();
    for (const std::string& name : view.names) vertex[name] = ply_view_detail::take_type(view.types[name], bytes, at);
  }
  return view;
}

}  // namespace arris::test
