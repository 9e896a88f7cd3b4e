#include "io/ply_vertices.h"

#include <fmt/format.h>

#include <cmath>

#include "core/text.h"
#include "io/bytes.h"
#include "io/ply_body.h"
#include "io/ply_field_names.h"

namespace arris::io {

SourceInfo make_ply_info(const InputFile& file, const PlyHeader& header, Tolerance tolerance) {
  SourceInfo info;
  info.path = file.path();
  info.format = Format::kPly;
  info.layout = fmt::format("PLY {} {}", header.format_name(), printable(header.version, 40));
  info.size_bytes = file.size_bytes();
  info.points = header.vertices().count;
  info.has_classes = find_ply_field(header.vertices(), "classification") >= 0;
  info.problems = header.problems;
  info.tolerance = tolerance;
  info.modified_ns = file.modified_ns();
  return info;
}

void salvage_vertices(const InputFile& file, const PlyHeader& header, std::uint64_t begin, SourceInfo& info) {
  if (info.tolerance != Tolerance::kSalvage) return;
  const WholeRecords whole = count_whole_records(file, header, header.vertex, begin);
  if (whole.count == info.points) return;
  info.problems.push_back({"points-lost",
                           fmt::format("{} of {} vertices are whole; {} from byte {} on are lost", whole.count,
                                       info.points, info.points - whole.count, whole.end),
                           whole.end});
  info.points = whole.count;
}

void note_short_elements(const InputFile& file, const PlyHeader& header, std::uint64_t vertices_end, SourceInfo& info) {
  std::uint64_t left = file.size_bytes() - vertices_end;
  bool fixed = true;
  for (std::size_t i = header.vertex + 1; i < header.elements.size(); ++i) {
    const PlyElement& element = header.elements[i];
    const auto least = checked_multiply(element.count, element.least_bytes());
    if (!least || *least > left) {
      info.problems.push_back({"elements-lost",
                               fmt::format("the {} {} records that the header counts behind the vertices do not fit "
                                           "the {} bytes that are left",
                                           element.count, printable(element.name, 40), left),
                               vertices_end});
      return;
    }
    left -= *least;
    fixed = fixed && !element.has_list();
  }
  if (fixed && left > 0) {
    info.problems.push_back({"trailing-bytes",
                             fmt::format("{} bytes follow the last element and belong to nothing", left),
                             file.size_bytes() - left});
  }
}

void start_ply_batch(PointBatch& batch, std::uint64_t first_id, std::size_t count, const PointExclusion& exclusion) {
  batch.first_id = first_id;
  batch.count = count;
  batch.excluded.assign(exclusion.only_classes.any() ? count : 0, 1);
  for (auto* stored : {&batch.ix, &batch.iy, &batch.iz}) stored->clear();
  for (auto* world : {&batch.x, &batch.y, &batch.z}) world->resize(count);
}

void mark_excluded(const PointExclusion& exclusion, std::span<const double> classes, std::size_t first,
                   PointBatch& batch) {
  const std::bitset<256> excluded = exclusion.excluded_classes();
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const double label = classes[i];
    const bool whole = label >= 0.0 && label <= 255.0 && label == std::floor(label);
    batch.excluded[first + i] = !whole || excluded[static_cast<std::size_t>(label)];
  }
}

}  // namespace arris::io
