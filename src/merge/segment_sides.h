#pragma once
/// @file On which side of its neighbour's plane a segment lies, near the border of the two.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/lattice.h"
#include "features/segment/segment_plane.h"

namespace arris::merge {

/// Sums over points, exact and so independent of their order. 48 bytes and more per pair of neighbouring segments.
class SegmentSides {
 public:
  explicit SegmentSides(const std::vector<SegmentPlane>& planes) : planes_(planes) {}

  /// A point of `segment` that has so many neighbours in `other`.
  void add(std::uint32_t segment, std::uint32_t other, const LatticePoint& p, std::int64_t neighbours = 1);
  /// What was added there, too.
  void add(const SegmentSides& more);

  /// +1 or -1: the points of `segment` near `other` lie on that side of its plane; 0: on neither, or not known.
  int side(std::uint32_t segment, std::uint32_t other) const;

 private:
  struct Sum {
    std::int64_t signed_steps = 0;
    std::int64_t steps = 0;
  };
  static std::uint64_t key(std::uint32_t segment, std::uint32_t other) { return std::uint64_t{segment} << 32 | other; }
  const std::vector<SegmentPlane>& planes_;
  std::unordered_map<std::uint64_t, Sum> sums_;
};

}  // namespace arris::merge
