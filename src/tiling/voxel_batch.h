#pragma once
/// @file Points of a batch and the voxels they lie in, by arrays. Private to VoxelLane.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/avx2.h"
#include "core/voxel.h"
#include "tiling/voxel_hash.h"

namespace arris::tiling {

/// Up to kSize points; what is behind them is whatever it was.
struct VoxelBatch {
  static constexpr std::size_t kSize = 128;

  std::array<std::int32_t, kSize> x{}, y{}, z{};
  std::array<std::uint32_t, kSize> offset_x{}, offset_y{}, offset_z{}, hash{};
  std::array<RawColour, kSize> colours;  ///< Where there are any.

  LatticePoint key(std::size_t i) const { return {x[i], y[i], z[i]}; }

  /// @param place  of the i-th among all points.
  template <class Place>
  void fill(const VoxelGrid& grid, std::span<const LatticePoint> positions, std::span<const RawColour> all_colours,
            std::size_t count, const Place& place) {
    for (std::size_t i = 0; i < count; ++i) {
      const LatticePoint& p = positions[place(i)];
      offset_x[i] = static_cast<std::uint32_t>(p.x);
      offset_y[i] = static_cast<std::uint32_t>(p.y);
      offset_z[i] = static_cast<std::uint32_t>(p.z);
    }
    if (!all_colours.empty()) {
      for (std::size_t i = 0; i < count; ++i) colours[i] = all_colours[place(i)];
    }
#if ARRIS_AVX2_VERSIONS
    if (may_use_avx2()) return divide_avx2(grid);
#endif
    divide(grid);
  }

 private:
  /// Whole arrays, axis by axis: these loops vectorise. Integers and one product each: the same bits everywhere.
  __attribute__((always_inline)) void divide(const VoxelGrid& grid) {
    divide(grid, offset_x, x);
    divide(grid, offset_y, y);
    divide(grid, offset_z, z);
    for (std::size_t i = 0; i < kSize; ++i) hash[i] = voxel_hash(x[i], y[i], z[i]);
  }
  /// Positions become offsets in voxels.
  __attribute__((always_inline)) static void divide(const VoxelGrid& grid, std::array<std::uint32_t, kSize>& offset,
                                                    std::array<std::int32_t, kSize>& voxel) {
    for (std::size_t i = 0; i < kSize; ++i) {
      voxel[i] = grid.voxel_of(static_cast<std::int32_t>(offset[i]));
      offset[i] -= grid.low_corner(voxel[i]);
    }
  }
#if ARRIS_AVX2_VERSIONS
  __attribute__((target("avx2"))) void divide_avx2(const VoxelGrid& grid) {
    divide(grid);
  }
#endif
};

}  // namespace arris::tiling
