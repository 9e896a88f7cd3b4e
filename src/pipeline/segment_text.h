#pragma once
/// @file Segments as CSV or JSON files.

#include <filesystem>
#include <span>

#include "merge/segment_row.h"
#include "pipeline/text_rows.h"

namespace arris::pipeline {

/// Columns, the same as names in JSON: segment_id, points, area, area_from ("outline", or "points": square spacing
/// times points), rms, x y z of the centroid, nx ny nz of the normal, inclination_deg (0 flat, 90 a wall), azimuth_deg
/// (downslope, clockwise from +y; empty, or null, below 0.1 degrees). Lengths in data units. CSV with a header line, or
/// a JSON array of objects. Check the name before (check_text_output).
void write_segments(const std::filesystem::path& path, std::span<const merge::SegmentRow> rows, bool overwrite);

}  // namespace arris::pipeline
