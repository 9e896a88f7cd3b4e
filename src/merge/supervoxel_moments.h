#pragma once
/// @file Exact moments of the points of each supervoxel, and what follows from them.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/lattice.h"
#include "features/supervoxel/supervoxel_table.h"
#include "tiling/growing_array.h"

namespace arris::merge {

/// Sums over points, whatever their order. Offsets are from the supervoxel's first point in the order of the inputs,
/// rounded down to multiples of 2^shift steps so that they stay below 2^17 and 2^28 points cannot overflow. 16 bytes
/// per supervoxel and 80 more for those of several points: where points are far apart most have one. Not thread-safe.
class SupervoxelMoments {
 public:
  /// @param count       supervoxels are numbered 1 .. count.
  /// @param reach_steps  no two points of a supervoxel are further apart along an axis.
  SupervoxelMoments(std::uint32_t count, std::int64_t reach_steps);

  void add(std::uint32_t id, const LatticePoint& p);
  std::uint64_t points(std::uint32_t id) const;

  /// @param adjacency  pairs a < b, ascending.
  SupervoxelTable table(std::span<const std::pair<std::uint32_t, std::uint32_t>> adjacency) const;
  /// No more than that, its table included, for so many supervoxels that have so many points and pairs of neighbours.
  static std::uint64_t most_bytes(std::uint64_t count, std::uint64_t points, std::uint64_t pairs);

 private:
  struct First {
    LatticePoint origin;
    std::uint32_t sums = kNoPoint;  ///< Where they are, or how few points there are.
  };
  struct Sums {
    std::uint64_t points = 0;
    std::array<std::int64_t, 3> first{};
    std::array<std::int64_t, 6> second{};  // xx xy xz yy yz zz
  };
  static constexpr std::uint32_t kNoPoint = 0xffffffffU;
  static constexpr std::uint32_t kOnePoint = 0xfffffffeU;

  const Sums& sums_of(std::uint32_t id) const;

  std::vector<First> first_;
  tiling::GrowingArray<Sums> sums_;  ///< Of those of several points.
  int shift_ = 0;
};

}  // namespace arris::merge
