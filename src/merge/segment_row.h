#pragma once
/// @file What tables and vector files say of a segment.

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "features/numerics/exact_math.h"

namespace arris::merge {

/// World coordinates and data units.
struct SegmentRow {
  std::uint32_t segment_id = 0;
  std::uint64_t points = 0;
  double area = 0.0;
  bool area_from_outline = false;               ///< Else square spacing times points.
  double rms = 0.0;                             ///< Of the points' distances from the plane.
  std::array<double, 3> centroid{};             ///< Of the points.
  std::array<double, 3> normal{0.0, 0.0, 1.0};  ///< Unit, upwards.

  /// 0 flat, 90 a wall.
  double inclination_deg() const {
    return angle_of(std::sqrt(normal[0] * normal[0] + normal[1] * normal[1]), std::fabs(normal[2])) * kDegreesPerRadian;
  }
  /// Downslope, clockwise from north (+y), [0, 360); none where the slope is below kFlat_deg and its direction is that
  /// of noise. Walls: the direction of the normal.
  std::optional<double> azimuth_deg() const {
    if (inclination_deg() < kFlat_deg) return std::nullopt;
    const double sign = normal[2] < 0.0 ? -1.0 : 1.0;
    const double azimuth = angle_of(sign * normal[0], sign * normal[1]) * kDegreesPerRadian;
    return azimuth < 0.0 ? azimuth + 360.0 : azimuth;
  }

  static constexpr double kFlat_deg = 0.1;
};

}  // namespace arris::merge
