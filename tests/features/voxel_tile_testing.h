#pragma once
/// @file Tiles of voxels made by the definition, and parts of them.

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "core/voxel_tile.h"
#include "features/supervoxel/voxel_features.h"

namespace arris::test {

/// All voxels of some points, all of them core. @param colours  as many as points, or none.
VoxelTile voxel_tile_of(std::int32_t side, const std::vector<LatticePoint>& points,
                        const std::vector<RawColour>& colours = {});

/// The voxels of `tile` inside `core` expanded by `halo` voxels; ranks are kept. `from` gets their indices in `tile`.
VoxelTile part_of(const VoxelTile& tile, const LatticeBox& core, std::int64_t halo, std::vector<std::uint32_t>& from);

/// The features of the voxels `from`, as they were.
VoxelFeatures part_of(const VoxelFeatures& features, const std::vector<std::uint32_t>& from);

/// The same voxels moved by whole voxels, in the same order.
VoxelTile moved(VoxelTile tile, const LatticePoint& voxels);

/// A bumpy surface of about `points` points `width` steps wide, with colours, cut by a step and pierced by holes.
struct BumpySurface {
  std::vector<LatticePoint> points;
  std::vector<RawColour> colours;
};
BumpySurface bumpy_surface(std::size_t points, std::int32_t width, std::uint64_t seed);

/// A box somewhere inside the keys of a tile.
LatticeBox any_core(const VoxelTile& tile, std::mt19937_64& random);

}  // namespace arris::test
