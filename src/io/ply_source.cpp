#include "io/ply_source.h"

#include "io/ply_header.h"
#include "io/ply_vertices.h"

namespace arris::io {

std::unique_ptr<PointSource> open_ply_source(std::shared_ptr<const InputFile> file, Tolerance tolerance) {
  PlyHeader header = read_ply_header(*file);
  if (header.format != PlyFormat::kAscii && !header.vertices().has_list()) {
    return open_ply_fixed_source(std::move(file), std::move(header), tolerance);
  }
  return open_ply_walked_source(std::move(file), std::move(header), tolerance);
}

}  // namespace arris::io
