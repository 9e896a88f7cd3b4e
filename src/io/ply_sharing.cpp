#include "io/ply_sharing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/text.h"
#include "io/input_file.h"

namespace arris::io {
namespace {

std::string property_text(const std::vector<PlyProperty>& properties, std::size_t index) {
  if (index >= properties.size()) return "nothing";
  const PlyProperty& p = properties[index];
  const std::string name = printable(p.name, 40);
  return p.is_list ? fmt::format("list {} {} {}", type_name(p.count_type), type_name(p.type), name)
                   : fmt::format("{} {}", type_name(p.type), name);
}

std::string difference(const PlyHeader& a, const PlyHeader& b) {
  if (a.format != b.format) return fmt::format("formats {} and {}", a.format_name(), b.format_name());
  const auto& x = a.vertices().properties;
  const auto& y = b.vertices().properties;
  const auto [at, other] = std::mismatch(x.begin(), x.end(), y.begin(), y.end());
  if (at == x.end() && other == y.end()) return {};
  const auto index = static_cast<std::size_t>(at - x.begin());
  return fmt::format("vertex property {} is {} in one and {} in the other", index + 1, property_text(x, index),
                     property_text(y, index));
}

bool speaks_of_vertices(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  constexpr std::array<std::string_view, 6> kHints{"vertex", "vertices", "vert", "point", "index", "indices"};
  return std::any_of(kHints.begin(), kHints.end(),
                     [&](std::string_view hint) { return name.find(hint) != std::string::npos; });
}

}  // namespace

std::string ply_difference(const std::vector<SourceInfo>& inputs) {
  if (inputs.size() < 2) return {};
  const PlyHeader first = read_ply_header(InputFile(inputs[0].path));
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    const std::string reason = difference(first, read_ply_header(InputFile(inputs[i].path)));
    if (!reason.empty()) return reason;
  }
  return {};
}

bool refers_to_vertices(const PlyElement& element) {
  return element.has_list() || element.name == "edge" || speaks_of_vertices(element.name) ||
         std::any_of(element.properties.begin(), element.properties.end(),
                     [](const PlyProperty& property) { return speaks_of_vertices(property.name); });
}

}  // namespace arris::io
