#include "support/ply_tools.h"

#include <string>

#include "support/las_tools.h"

namespace arris::test {

std::vector<std::filesystem::path> split_ply_file(const std::filesystem::path& path, int parts,
                                                  const std::filesystem::path& folder) {
  const std::string bytes = file_bytes(path);
  const std::string end = "end_header\n";
  const std::string element = "element vertex ";
  const std::size_t body = bytes.find(end) + end.size();
  const std::size_t count_at = bytes.find(element) + element.size();
  const std::size_t count_end = bytes.find('\n', count_at);
  const std::size_t vertices = std::stoull(bytes.substr(count_at));
  const std::size_t vertex_bytes = vertices == 0 ? 0 : (bytes.size() - body) / vertices;
  std::vector<std::filesystem::path> paths;
  for (std::size_t part = 0; part < static_cast<std::size_t>(parts); ++part) {
    const std::size_t first = vertices * part / static_cast<std::size_t>(parts);
    const std::size_t last = vertices * (part + 1) / static_cast<std::size_t>(parts);
    paths.push_back(folder / ("part" + std::to_string(part) + ".ply"));
    write_bytes(paths.back(), bytes.substr(0, count_at) + std::to_string(last - first) +
                                  bytes.substr(count_end, body - count_end) +
                                  bytes.substr(body + first * vertex_bytes, (last - first) * vertex_bytes));
  }
  return paths;
}

}  // namespace arris::test
