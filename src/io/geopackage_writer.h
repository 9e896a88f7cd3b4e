#pragma once
/// @file Polygons of planar segments as a GeoPackage 1.3 (OGC 12-128r17).

#include <cstdint>
#include <filesystem>
#include <memory>

#include "io/las_crs.h"
#include "io/polygon_feature.h"

namespace arris::io {

/// One layer "segments": a POLYGON Z per row with segment_id, points, area, rms, inclination_deg and azimuth_deg (NULL
/// where it is flat). Lengths and areas are in the units of the coordinates, whatever those are.
///
/// The coordinate reference system is the EPSG code if it is known, with the WKT as its definition; a WKT without a
/// code is number 100000; anything else is -1, "undefined Cartesian".
///
/// The file appears whole with commit(), or not at all (output_file.h). Law: the same features in the same order give
/// the same bytes (with the same version of SQLite, which notes its number in the file): the time of the last change is
/// the fixed 1970-01-01. Memory: 2 MB and one polygon. Not thread-safe. Throws IoError, ConfigError as OutputFile.
class GeoPackageWriter {
 public:
  GeoPackageWriter(const std::filesystem::path& path, bool overwrite, const CrsSummary& crs);
  ~GeoPackageWriter();
  GeoPackageWriter(const GeoPackageWriter&) = delete;
  GeoPackageWriter& operator=(const GeoPackageWriter&) = delete;

  void add(const PolygonFeature& feature);
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::io
