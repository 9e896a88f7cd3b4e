#pragma once
/// @file Outlines of planar segments as Wavefront OBJ.

#include <cstdint>
#include <filesystem>

#include "io/output_file.h"
#include "io/polygon_feature.h"

namespace arris::io {

/// A group `g segment_12` per segment, with its rings as vertices `v` and closed lines `l` (the first vertex is
/// repeated as index). Lines and not faces: CloudCompare and Blender both show them as they are, holes included, while
/// CloudCompare cuts faces into fans, which is wrong for outlines that are not convex, and faces cannot have holes. In
/// Blender "Make Edge/Face" (F) fills a ring.
///
/// The file appears whole with commit(), or not at all (output_file.h). Not thread-safe.
class ObjPolygonWriter {
 public:
  /// @param decimals  of coordinates, 0 to 15.
  ObjPolygonWriter(const std::filesystem::path& path, bool overwrite, int decimals);

  /// Polygons of one segment come one after the other.
  void add(const PolygonFeature& feature);
  void commit() { file_.commit(); }

 private:
  void add_ring(const PolygonRing& ring);

  OutputFile file_;
  int decimals_;
  std::uint32_t group_ = 0;
  std::uint64_t vertices_ = 0;
};

}  // namespace arris::io
