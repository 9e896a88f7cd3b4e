#include "io/obj_polygons.h"

#include <fmt/format.h>

#include <string>

namespace arris::io {

ObjPolygonWriter::ObjPolygonWriter(const std::filesystem::path& path, bool overwrite, int decimals)
    : file_(path, overwrite), decimals_(decimals) {
  file_.write(std::string_view("# Outlines of planar segments\n"));
}

void ObjPolygonWriter::add(const PolygonFeature& feature) {
  if (feature.segment_id != group_) {
    group_ = feature.segment_id;
    file_.write(std::string_view(fmt::format("g segment_{}\n", group_)));
  }
  add_ring(feature.outer);
  for (const PolygonRing& hole : feature.holes) add_ring(hole);
}

void ObjPolygonWriter::add_ring(const PolygonRing& ring) {
  std::string text;
  for (const auto& p : ring)
    fmt::format_to(std::back_inserter(text), "v {:.{}f} {:.{}f} {:.{}f}\n", p[0], decimals_, p[1], decimals_, p[2],
                   decimals_);
  text += 'l';
  for (std::size_t i = 1; i <= ring.size(); ++i) fmt::format_to(std::back_inserter(text), " {}", vertices_ + i);
  fmt::format_to(std::back_inserter(text), " {}\n", vertices_ + 1);
  file_.write(std::string_view(text));
  vertices_ += ring.size();
}

}  // namespace arris::io
