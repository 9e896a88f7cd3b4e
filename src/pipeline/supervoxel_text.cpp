#include "pipeline/supervoxel_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "io/output_file.h"

namespace arris::pipeline {
namespace {

std::string extension(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Lines of CSV below `header`, or elements of one JSON array; written as they come.
class Rows {
 public:
  Rows(const std::filesystem::path& path, const char* header, bool overwrite)
      : file_(path, overwrite), json_(extension(path) == ".json") {
    file_.write(json_ ? std::string_view("[\n") : std::string_view(fmt::format("{}\n", header)));
  }
  bool json() const { return json_; }
  void add(const std::string& row) {
    if (json_ && !first_) file_.write(std::string_view(",\n"));
    first_ = false;
    file_.write(std::string_view(row));
    if (!json_) file_.write(std::string_view("\n"));
  }
  void commit() {
    if (json_) file_.write(std::string_view("\n]\n"));
    file_.commit();
  }

 private:
  io::OutputFile file_;
  bool json_;
  bool first_ = true;
};

}  // namespace

void require_text_format(const std::filesystem::path& path, const char* option) {
  if (path.empty()) return;
  const std::string text = extension(path);
  if (text != ".csv" && text != ".json")
    throw ConfigError(fmt::format("{} {}: the name must end in .csv or .json", option, path.string()));
}

void write_supervoxel_table(const std::filesystem::path& path, const SupervoxelTable& table,
                            const merge::SupervoxelMoments& moments, const Lattice& lattice, bool overwrite) {
  Rows rows(path, "id,points,x,y,z,nx,ny,nz,area,thickness", overwrite);
  for (std::uint32_t id = 1; id < table.size(); ++id) {
    const double n = static_cast<double>(moments.points(id));
    std::array<double, 3> centre{};
    for (int axis = 0; axis < 3; ++axis)
      centre[static_cast<std::size_t>(axis)] = lattice.origin[static_cast<std::size_t>(axis)] +
                                               lattice.step * table.centroid[id][static_cast<std::size_t>(axis)];
    const double spacing = lattice.step * table.spacing[id];
    const char* const form =
        rows.json()
            ? R"({{"id":{},"points":{},"x":{:.4f},"y":{:.4f},"z":{:.4f},"nx":{:.6f},"ny":{:.6f},"nz":{:.6f},"area":{:.6g},"thickness":{:.6g}}})"
            : "{},{},{:.4f},{:.4f},{:.4f},{:.6f},{:.6f},{:.6f},{:.6g},{:.6g}";
    rows.add(fmt::format(fmt::runtime(form), id, moments.points(id), centre[0], centre[1], centre[2],
                         table.normal[id][0], table.normal[id][1], table.normal[id][2], spacing * spacing * n,
                         lattice.step * table.thickness[id]));
  }
  rows.commit();
}

void write_adjacency(const std::filesystem::path& path, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs,
                     bool overwrite) {
  Rows rows(path, "a,b", overwrite);
  for (const auto& [a, b] : pairs) rows.add(rows.json() ? fmt::format("[{},{}]", a, b) : fmt::format("{},{}", a, b));
  rows.commit();
}

}  // namespace arris::pipeline
