#pragma once
/// @file Voxels: cubes of a whole number of lattice steps, counted from the lattice origin, and what is kept of the
/// points in them.

#include <array>
#include <cstdint>

#include "core/lattice.h"

namespace arris {

/// Largest side of a voxel in steps: moments over a neighbourhood of voxels stay exact in int64.
constexpr std::int32_t kMostVoxelSide = 1 << 20;
/// Positions inside a voxel are kept in fractions of a step.
constexpr std::int32_t kVoxelFractions = 16;

/// Voxel (i, j, k) is centred on side * (i, j, k): it holds the lattice points p with floor((p + side / 2) / side) ==
/// (i, j, k) per axis. Centred on multiples, because surfaces at round coordinates (floors, walls of models) would
/// otherwise run along faces of voxels, and noise would scatter their points over two layers. Immutable.
class VoxelGrid {
 public:
  /// @param side_steps  1 .. kMostVoxelSide (ConfigError otherwise).
  explicit VoxelGrid(std::int32_t side_steps);
  std::int32_t side_steps() const { return side_steps_; }

  std::int32_t voxel_of(std::int32_t position) const {
    // The product is off by less than 1e-6 voxels: one comparison repairs the floor. The rest is known to be small, so
    // it is computed modulo 2^32, which compilers vectorise.
    const auto voxel = static_cast<std::int32_t>((static_cast<double>(position) + half_) * inverse_);
    const auto rest = static_cast<std::int32_t>(static_cast<std::uint32_t>(position) - low_corner(voxel));
    return voxel - (rest < 0 ? 1 : 0) + (rest >= side_steps_ ? 1 : 0);
  }
  LatticePoint voxel_of(const LatticePoint& p) const { return {voxel_of(p.x), voxel_of(p.y), voxel_of(p.z)}; }
  /// Lowest lattice position of a voxel along one axis; may lie below int32.
  std::int64_t corner(std::int32_t voxel) const { return std::int64_t{voxel} * side_steps_ - half_; }
  /// The same modulo 2^32: for offsets from it, which are small.
  std::uint32_t low_corner(std::int32_t voxel) const {
    return static_cast<std::uint32_t>(voxel) * static_cast<std::uint32_t>(side_steps_) -
           static_cast<std::uint32_t>(half_);
  }

 private:
  std::int32_t side_steps_;
  std::int32_t half_;
  double inverse_;
};

/// Colours as they are stored in the inputs, 16 bits per channel.
using RawColour = std::array<std::uint16_t, 3>;

/// A voxel that holds points.
struct Voxel {
  LatticePoint key;  ///< (i, j, k).
  std::array<std::uint32_t, 3>
      centroid{};      ///< Mean of its points from its lowest corner, in 1 / kVoxelFractions steps, nearest (half up).
  RawColour colour{};  ///< Mean of its points, nearest (half up); 0 without colours.

  friend bool operator==(const Voxel&, const Voxel&) = default;
};

}  // namespace arris
