#pragma once
/// @file Outlines of segments as vector files, by the extension of their names.

#include <filesystem>
#include <memory>
#include <span>

#include "core/lattice.h"
#include "features/segment/segment_plane.h"
#include "io/las_crs.h"
#include "io/polygon_feature.h"
#include "merge/outline_rings.h"
#include "merge/segment_row.h"

namespace arris::pipeline {

/// Before any work: throws ConfigError unless the name (if not empty) ends in .gpkg or .obj and is free or may be
/// overwritten.
void check_outline_output(const std::filesystem::path& path, const char* option, bool overwrite);

/// One feature per polygon; its vertices are the feet of the points on the segment's plane, so that it is planar.
std::vector<io::PolygonFeature> polygon_features(const merge::SegmentOutline& outline, const SegmentPlane& plane,
                                                 const merge::SegmentRow& row, const Lattice& lattice);

/// Writes outlines as they come, segment by segment. The file appears whole with commit(), or not at all.
class OutlineOutput {
 public:
  /// GeoPackage or OBJ. @param crs  of the inputs, for GeoPackage.
  OutlineOutput(const std::filesystem::path& path, bool overwrite, const io::CrsSummary& crs, const Lattice& lattice);
  ~OutlineOutput();
  OutlineOutput(const OutlineOutput&) = delete;
  OutlineOutput& operator=(const OutlineOutput&) = delete;

  void add(const merge::SegmentOutline& outline, const SegmentPlane& plane, const merge::SegmentRow& row);
  void commit();

 private:
  struct Writer;
  Lattice lattice_;
  std::unique_ptr<Writer> writer_;
};

}  // namespace arris::pipeline
