#include "pipeline/supervoxel_text.h"

#include <fmt/format.h>

namespace arris::pipeline {

void write_supervoxel_table(const std::filesystem::path& path, const SupervoxelTable& table,
                            const merge::SupervoxelMoments& moments, const Lattice& lattice, bool overwrite) {
  TextRows rows(path, "id,points,x,y,z,nx,ny,nz,area,thickness", overwrite);
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
  TextRows rows(path, "a,b", overwrite);
  for (const auto& [a, b] : pairs) rows.add(rows.json() ? fmt::format("[{},{}]", a, b) : fmt::format("{},{}", a, b));
  rows.commit();
}

}  // namespace arris::pipeline
