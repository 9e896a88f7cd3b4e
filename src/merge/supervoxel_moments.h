#pragma once
/// @file Exact moments of the points of each supervoxel, and what follows from them.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/lattice.h"
#include "features/supervoxel/supervoxel_table.h"

namespace arris::merge {

/// Sums over points, whatever their order. Offsets are from the supervoxel's first point in the order of the inputs,
/// rounded down to multiples of 2^shift steps so that they stay below 2^17 and 2^28 points cannot overflow. 96 bytes
/// per supervoxel. Not thread-safe.
class SupervoxelMoments {
 public:
  /// @param count       supervoxels are numbered 1 .. count.
  /// @param reach_steps  no two points of a supervoxel are further apart along an axis.
  SupervoxelMoments(std::uint32_t count, std::int64_t reach_steps);

  void add(std::uint32_t id, const LatticePoint& p);
  std::uint64_t points(std::uint32_t id) const { return sums_[id].points; }

  /// @param adjacency  pairs a < b, ascending.
  SupervoxelTable table(std::span<const std::pair<std::uint32_t, std::uint32_t>> adjacency) const;
  static std::uint64_t bytes_per_supervoxel();

 private:
  struct Sums {
    std::uint64_t points = 0;
    LatticePoint origin;
    std::array<std::int64_t, 3> first{};
    std::array<std::int64_t, 6> second{};  // xx xy xz yy yz zz
  };
  std::vector<Sums> sums_;
  int shift_ = 0;
};

}  // namespace arris::merge
