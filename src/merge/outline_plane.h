#pragma once
/// @file Outline vertices in the plane of their segment, exactly.

#include <cstdint>

#include "core/lattice.h"
#include "features/planar/plane_frame.h"
#include "features/segment/segment_plane.h"

namespace arris::merge {

/// In units of 2^-kFrameBits steps; below 2^51 for all of the lattice.
struct PlanePosition {
  std::int64_t x = 0, y = 0;

  friend bool operator==(const PlanePosition&, const PlanePosition&) = default;
};

/// Twice the area of the triangle a b c, > 0 if it goes counterclockwise.
using Area = __int128;
inline Area turn(const PlanePosition& a, const PlanePosition& b, const PlanePosition& c) {
  return static_cast<Area>(b.x - a.x) * (c.y - a.y) - static_cast<Area>(b.y - a.y) * (c.x - a.x);
}

class OutlinePlane {
 public:
  explicit OutlinePlane(const SegmentPlane& plane) : plane_(plane), frame_(plane_frame(plane.normal)) {}

  PlanePosition operator()(const LatticePoint& p) const {
    const Vector3 at{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
    return {frame_units(dot(frame_.u, at)), frame_units(dot(frame_.v, at))};
  }
  /// Square steps of one square unit: the frame is not quite orthonormal.
  double square_steps() const {
    constexpr double kUnit = 1.0 / static_cast<double>(std::int64_t{1} << kFrameBits);
    return kUnit * kUnit / dot(cross(frame_.u, frame_.v), plane_.normal);
  }

 private:
  SegmentPlane plane_;
  PlaneFrame frame_;
};

}  // namespace arris::merge
