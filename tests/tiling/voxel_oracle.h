#pragma once
/// @file Voxels by the definition, for comparison, and damage to files.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <vector>

#include "core/voxel.h"
#include "tiling/morton.h"

namespace arris::test {

inline std::int64_t floor_divided(std::int64_t a, std::int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

/// The voxel, centred on a multiple of `side`, that holds a position; and its lowest position.
inline std::int64_t centred_voxel(std::int64_t position, std::int64_t side) {
  return floor_divided(position + side / 2, side);
}
inline std::int64_t voxel_corner(std::int64_t voxel, std::int64_t side) {
  return voxel * side - side / 2;
}

/// Voxels of the points in Z-order. Colours: as many as points or none.
inline std::vector<Voxel> voxels_of(std::int32_t side, std::span<const LatticePoint> points,
                                    std::span<const RawColour> colours) {
  struct Sums {
    __int128 points = 0, offset[3] = {}, colour[3] = {};
  };
  std::map<LatticePoint, Sums> sums;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::int32_t key[3];
    for (int axis = 0; axis < 3; ++axis) key[axis] = static_cast<std::int32_t>(centred_voxel(points[i][axis], side));
    Sums& sum = sums[{key[0], key[1], key[2]}];
    ++sum.points;
    for (int axis = 0; axis < 3; ++axis) {
      sum.offset[axis] += points[i][axis] - voxel_corner(key[axis], side);
      if (!colours.empty()) sum.colour[axis] += colours[i][static_cast<std::size_t>(axis)];
    }
  }
  std::vector<Voxel> voxels;
  for (const auto& [key, sum] : sums) {
    Voxel voxel;
    voxel.key = key;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const __int128 n = sum.points;
      voxel.centroid[axis] = static_cast<std::uint32_t>((2 * kVoxelFractions * sum.offset[axis] + n) / (2 * n));
      voxel.colour[axis] = static_cast<std::uint16_t>((2 * sum.colour[axis] + n) / (2 * n));
    }
    voxels.push_back(voxel);
  }
  std::ranges::sort(voxels, [](const Voxel& a, const Voxel& b) { return tiling::z_order_less(a.key, b.key); });
  return voxels;
}

/// Damages a file by one bit.
inline void flip_bit(const std::filesystem::path& path, std::size_t byte, int bit) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(static_cast<std::streamoff>(byte));
  const char flipped = static_cast<char>(file.get() ^ (1 << bit));
  file.seekp(static_cast<std::streamoff>(byte));
  file.put(flipped);
}

}  // namespace arris::test
