#pragma once
/// @file The voxels of one tile as the supervoxel method sees them.

#include <array>
#include <cstdint>
#include <span>

#include "core/lattice.h"
#include "core/pages.h"
#include "core/voxel.h"

namespace arris {

/// A position in 1 / kVoxelFractions lattice steps, modulo 2^32 per axis. Only differences have a meaning; they are
/// exact below 2^31 fractions (2^27 steps).
using VoxelPosition = std::array<std::uint32_t, 3>;

inline std::int32_t difference(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::int32_t>(a - b);
}

/// Voxels of a core and its halo as structure of arrays, in Z-order of their keys. Nothing that is computed for a core
/// voxel may depend on where the halo ends.
struct VoxelTile {
  explicit VoxelTile(const VoxelGrid& voxel_grid) : grid(voxel_grid) {}

  VoxelGrid grid;
  PageVector<LatticePoint> keys;
  PageVector<VoxelPosition> positions;  ///< Centroids.
  PageVector<RawColour> colours;        ///< Empty if colours take no part.
  PageVector<std::uint32_t> ranks;      ///< Among all voxels of the scan, ascending.
  PageVector<std::uint8_t> core;        ///< 1: owned by this tile.
  /// neighbours[neighbour_begin[v] .. neighbour_begin[v + 1]): the existing ones of the 26 voxels around v, in
  /// ascending (dx, dy, dz).
  PageVector<std::uint32_t> neighbour_begin;
  PageVector<std::uint32_t> neighbours;

  std::size_t size() const { return keys.size(); }
  std::span<const std::uint32_t> neighbours_of(std::size_t v) const {
    return {neighbours.data() + neighbour_begin[v], neighbour_begin[v + 1] - neighbour_begin[v]};
  }
};

}  // namespace arris
