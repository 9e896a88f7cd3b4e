#include "pipeline/outline_output.h"

#include <optional>

#include "io/geopackage_writer.h"
#include "io/obj_polygons.h"
#include "pipeline/output_name.h"

namespace arris::pipeline {
namespace {

/// A tenth of a lattice step: feet of points lie between the steps.
int decimals(const Lattice& lattice) {
  int digits = 1;
  for (double step = lattice.step; step < 0.999 && digits < 15; step *= 10.0) ++digits;
  return digits;
}

io::PolygonRing on_plane(const merge::OutlineRing& ring, const SegmentPlane& plane, const Lattice& lattice) {
  io::PolygonRing positions;
  positions.reserve(ring.size());
  for (const merge::OutlineVertex& v : ring) {
    const double distance = signed_distance(plane, v.position);
    auto& position = positions.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      position[a] = lattice.world(axis, v.position[axis]) - lattice.step * distance * plane.normal[a];
    }
  }
  return positions;
}

}  // namespace

void check_outline_output(const std::filesystem::path& path, const char* option, bool overwrite) {
  check_output_name(path, option, overwrite, {".gpkg", ".obj"});
}

std::vector<io::PolygonFeature> polygon_features(const merge::SegmentOutline& outline, const SegmentPlane& plane,
                                                 const merge::SegmentRow& row, const Lattice& lattice) {
  std::vector<io::PolygonFeature> features;
  for (const merge::OutlinePolygon& polygon : outline.polygons) {
    io::PolygonFeature& feature = features.emplace_back();
    feature.segment_id = row.segment_id;
    feature.points = row.points;
    feature.area = polygon.area;
    feature.rms = row.rms;
    feature.inclination_deg = row.inclination_deg();
    feature.azimuth_deg = row.azimuth_deg();
    feature.outer = on_plane(polygon.outer, plane, lattice);
    for (const merge::OutlineRing& hole : polygon.holes) feature.holes.push_back(on_plane(hole, plane, lattice));
  }
  return features;
}

struct OutlineOutput::Writer {
  std::optional<io::GeoPackageWriter> geopackage;
  std::optional<io::ObjPolygonWriter> obj;
};

OutlineOutput::OutlineOutput(const std::filesystem::path& path, bool overwrite, const io::CrsSummary& crs,
                             const Lattice& lattice)
    : lattice_(lattice), writer_(std::make_unique<Writer>()) {
  if (small_extension(path) == ".obj") {
    writer_->obj.emplace(path, overwrite, decimals(lattice));
  } else {
    writer_->geopackage.emplace(path, overwrite, crs);
  }
}

OutlineOutput::~OutlineOutput() = default;

void OutlineOutput::add(const merge::SegmentOutline& outline, const SegmentPlane& plane, const merge::SegmentRow& row) {
  for (const io::PolygonFeature& feature : polygon_features(outline, plane, row, lattice_)) {
    if (writer_->geopackage) writer_->geopackage->add(feature);
    if (writer_->obj) writer_->obj->add(feature);
  }
}

void OutlineOutput::commit() {
  if (writer_->geopackage) writer_->geopackage->commit();
  if (writer_->obj) writer_->obj->commit();
}

}  // namespace arris::pipeline
