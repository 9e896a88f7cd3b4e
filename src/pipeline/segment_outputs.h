#pragma once
/// @file The files of `arris segment` beside the points: a table of segments, and their outlines.

#include <filesystem>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "io/point_source.h"
#include "merge/outline_rings.h"
#include "merge/segment_row.h"
#include "pipeline/segment_planes.h"

namespace arris::pipeline {

/// One row per segment. @param outlines  ascending; segments without one get their area from their points.
std::vector<merge::SegmentRow> segment_rows(const PlanarSegments& segments,
                                            std::span<const merge::SegmentOutline> outlines, const Lattice& lattice);

/// Writes outlines to `path` (.gpkg, .obj), with the reference system of the first input that names one.
void write_outlines(const std::filesystem::path& path, bool overwrite, const io::InputSet& inputs,
                    std::span<const merge::SegmentOutline> outlines, const PlanarSegments& segments,
                    std::span<const merge::SegmentRow> rows, const Lattice& lattice);

}  // namespace arris::pipeline
