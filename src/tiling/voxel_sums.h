#pragma once
/// @file Sums of the points of a voxel, and their mean.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "core/voxel.h"

namespace arris::tiling {

/// Sums of some of the points of a voxel: few enough that they fit 32 bits (most_points_summed). 28 bytes, no padding.
struct VoxelSums {
  LatticePoint key;
  std::uint32_t points = 0;
  std::array<std::uint32_t, 3> offset{};  ///< From the voxel's lowest corner, steps.
};
static_assert(sizeof(VoxelSums) == 28);
using ColourSums = std::array<std::uint32_t, 3>;

/// As written to runs; the last 12 bytes are left out where no point has a colour.
struct VoxelRecord {
  VoxelSums sums;
  ColourSums colour{};
};
static_assert(sizeof(VoxelRecord) == 40);

/// So many points can be summed in 32 bits: with them no sum overflows.
inline std::uint32_t most_points_summed(std::int32_t side_steps, bool colours) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::uint32_t by_offset = kMost / static_cast<std::uint32_t>(std::max(side_steps - 1, 1));
  return colours ? std::min(by_offset, kMost / std::numeric_limits<std::uint16_t>::max()) : by_offset;
}

/// Sums of all points of a voxel. Exact up to 2^38 points: nothing exceeds 2^63 then.
class VoxelTotal {
 public:
  explicit VoxelTotal(const LatticePoint& key) : key_(key) {}
  const LatticePoint& key() const { return key_; }
  std::uint64_t points() const { return points_; }

  void add(const VoxelRecord& record) {
    points_ += record.sums.points;
    for (std::size_t axis = 0; axis < 3; ++axis) offset_[axis] += record.sums.offset[axis];
    for (std::size_t channel = 0; channel < 3; ++channel) colour_[channel] += record.colour[channel];
  }

  /// At least one point must have been added.
  Voxel mean() const {
    Voxel voxel;
    voxel.key = key_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      voxel.centroid[axis] = static_cast<std::uint32_t>(rounded(offset_[axis] * kVoxelFractions));
    }
    if ((colour_[0] | colour_[1] | colour_[2]) == 0) return voxel;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      voxel.colour[channel] = static_cast<std::uint16_t>(rounded(colour_[channel]));
    }
    return voxel;
  }

 private:
  /// sum / points, nearest, half up.
  std::uint64_t rounded(std::uint64_t sum) const { return (2 * sum + points_) / (2 * points_); }

  LatticePoint key_;
  std::uint64_t points_ = 0;
  std::array<std::uint64_t, 3> offset_{};
  std::array<std::uint64_t, 3> colour_{};
};

}  // namespace arris::tiling
