#pragma once
/// @file Exact moments of the points of each segment, and the planes that follow from them.

#include <array>
#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "features/segment/segment_plane.h"

namespace arris::merge {

/// Sums over points, whatever the order of adding and removing. Segments are numbered 1 .. count. Offsets are from
/// the first point added to the segment; sums are 128 bits wide and cannot overflow (2^32 points, 2^64
/// per square). 176 bytes per segment. Not thread-safe.
class SegmentMoments {
 public:
  explicit SegmentMoments(std::uint32_t count) : sums_(count) {}

  std::uint32_t count() const { return static_cast<std::uint32_t>(sums_.size()); }
  std::uint64_t points(std::uint32_t segment) const { return sums_[segment - 1].points; }
  void add(std::uint32_t segment, const LatticePoint& p) { change(segment, p, 1); }
  void remove(std::uint32_t segment, const LatticePoint& p) { change(segment, p, -1); }

  /// Least-squares plane: through the mean, normal of least variance. Segments without points, or with all of them on a
  /// line, have the normal that principal_frame() gives. SegmentPlane::spacing is left alone.
  SegmentPlane plane(std::uint32_t segment) const;

  static constexpr std::uint64_t kBytesPerSegment = 176;

 private:
  __extension__ using Wide = __int128;
  struct Sums {
    std::uint64_t points = 0;
    bool has_origin = false;
    LatticePoint origin;
    std::array<Wide, 3> first{};
    std::array<Wide, 6> second{};  // xx xy xz yy yz zz
  };
  void change(std::uint32_t segment, const LatticePoint& p, int sign);

  std::vector<Sums> sums_;
};

}  // namespace arris::merge
