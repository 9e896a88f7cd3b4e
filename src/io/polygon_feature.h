#pragma once
/// @file A polygon of a planar segment with what is known of it, as writers of vector formats take it.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace arris::io {

/// World coordinates. At least three different positions; the first is not repeated at the end.
using PolygonRing = std::vector<std::array<double, 3>>;

struct PolygonFeature {
  std::uint32_t segment_id = 0;
  std::uint64_t points = 0;           ///< Of the whole segment.
  double area = 0.0;                  ///< Of this polygon in its plane, without the holes, square data units.
  double rms = 0.0;                   ///< Of the distances of the segment's points from its plane, data units.
  double inclination_deg = 0.0;       ///< Of the plane: 0 flat, 90 a wall.
  std::optional<double> azimuth_deg;  ///< Downslope, clockwise from +y; none where it is flat.
  PolygonRing outer;
  std::vector<PolygonRing> holes;
};

}  // namespace arris::io
