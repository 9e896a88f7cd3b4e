#pragma once
/// @file Tiles of voxels: cut by their number, loaded with their halo and neighbours.

#include <cstdint>
#include <functional>

#include "core/voxel_tile.h"
#include "tiling/tile_plan.h"
#include "tiling/voxel_neighbours.h"
#include "tiling/voxel_store.h"

namespace arris::tiling {

struct VoxelPlanRequest {
  /// Most covered voxels of a tile, >= 1; exceeded only by a tile of one 8^3 block, and where the halo alone is so
  /// large that the core is less than 1/64 of this.
  std::uint64_t max_voxels = 0;
  std::uint64_t max_core_voxels = 0;  ///< Most core voxels, likewise; 0: no such limit.
  std::int32_t halo_voxels = 0;       ///< >= 0.
};

/// Calls visit(key of a block, voxels in it) for blocks, in any order.
using VisitBlock = std::function<void(const LatticePoint& block_key, std::uint64_t voxels)>;
using VoxelBlocks = std::function<void(const VisitBlock& visit)>;

/// As plan_tiles(), with boxes and counts in voxels; boxes are of whole blocks of the index. One tile without cuts if
/// all voxels fit.
TilePlan plan_voxel_tiles(const VoxelBlocks& blocks, const VoxelPlanRequest& request);
TilePlan plan_voxel_tiles(const VoxelIndex& index, const VoxelPlanRequest& request);

/// The voxels of a tile's covered box, which is of whole blocks, without neighbours. @param colours  keep colours.
/// Reads in parallel. Memory: 29 bytes per voxel, 35 with colours. Throws IoError.
VoxelTile load_voxels(const VoxelStore& store, const PlannedTile& tile, bool colours);
/// The same with their neighbours inside the box. Links in parallel. Memory: 4 bytes more, and 4 per neighbour.
/// @param begins  of this tile: see link_neighbours().
VoxelTile load_voxel_tile(const VoxelStore& store, const PlannedTile& tile, bool colours, LinkBegins& begins);

}  // namespace arris::tiling
