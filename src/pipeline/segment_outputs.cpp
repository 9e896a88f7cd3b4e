#include "pipeline/segment_outputs.h"

#include "io/file_summary.h"
#include "pipeline/outline_output.h"

namespace arris::pipeline {

std::vector<merge::SegmentRow> segment_rows(const PlanarSegments& segments,
                                            std::span<const merge::SegmentOutline> outlines, const Lattice& lattice) {
  std::vector<merge::SegmentRow> rows(segments.planes.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const SegmentPlane& plane = segments.planes[i];
    merge::SegmentRow& row = rows[i];
    row.segment_id = static_cast<std::uint32_t>(i + 1);
    row.points = segments.points[i];
    const double spacing = plane.spacing * lattice.step;
    row.area = spacing * spacing * static_cast<double>(row.points);
    row.rms = plane.rms * lattice.step;
    row.normal = plane.normal;
    for (std::size_t axis = 0; axis < 3; ++axis)
      row.centroid[axis] = lattice.origin[axis] + lattice.step * plane.centroid[axis];
  }
  for (const merge::SegmentOutline& outline : outlines) {
    merge::SegmentRow& row = rows[outline.segment - 1];
    row.area = outline.area;
    row.area_from_outline = true;
  }
  return rows;
}

void write_outlines(const std::filesystem::path& path, bool overwrite, const io::InputSet& inputs,
                    std::span<const merge::SegmentOutline> outlines, const PlanarSegments& segments,
                    std::span<const merge::SegmentRow> rows, const Lattice& lattice) {
  io::CrsSummary crs;
  for (const io::SourceInfo& source : inputs.sources()) {
    if (!crs.text.empty()) break;
    crs = io::summarize_file(source.path, source.tolerance).crs;
  }
  OutlineOutput output(path, overwrite, crs, lattice);
  for (const merge::SegmentOutline& outline : outlines)
    output.add(outline, segments.planes[outline.segment - 1], rows[outline.segment - 1]);
  output.commit();
}

}  // namespace arris::pipeline
