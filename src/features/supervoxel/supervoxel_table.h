#pragma once
/// @file What is known of all supervoxels of a scan.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace arris {

/// Indexed by supervoxel id; id 0 means none and has meaningless entries. Everything derives from exact sums over the
/// whole scan, so it is the same for every tile.
struct SupervoxelTable {
  std::vector<std::array<float, 3>> normal;  ///< Unit, sign arbitrary: least-squares plane of all member points; (0, 0,
                                             ///< 0) where undefined (fewer than 3 points, or collinear).
  std::vector<std::array<double, 3>> centroid;  ///< Mean of all member points, lattice steps.
  std::vector<float> spacing;    ///< Steps: sqrt(area / points) of the member points in their plane; 0 where undefined.
  std::vector<float> thickness;  ///< Steps: RMS distance of member points from their plane.
  /// neighbours[begin[i] .. begin[i + 1]): ids, ascending, of the supervoxels that have a voxel among the 26 neighbours
  /// of a voxel of i.
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> neighbours;

  std::size_t size() const { return normal.size(); }
  bool adjacent(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(neighbours.begin() + begin[a], neighbours.begin() + begin[a + 1], b);
  }
};

}  // namespace arris
