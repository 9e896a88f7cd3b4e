#pragma once
/// @file Geometries as GeoPackage keeps them (OGC 12-128r17, clause 2.1.3): a header with an envelope, and ISO WKB.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/polygon_feature.h"

namespace arris::io {

struct PolygonEnvelope {
  std::array<double, 3> min{}, max{};
};

PolygonEnvelope envelope_of(const PolygonFeature& feature);

/// POLYGON Z, little-endian; rings are closed by repeating their first position.
std::vector<std::byte> geopackage_polygon(const PolygonFeature& feature, std::int32_t srs_id);

}  // namespace arris::io
