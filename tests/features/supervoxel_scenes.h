#pragma once
/// @file Supervoxels made from what is known of a scene, and what the table says of them.

#include <cstdint>
#include <span>
#include <vector>

#include "contour_scenes.h"
#include "core/tile_points.h"
#include "features/supervoxel/supervoxel_table.h"

namespace arris::test {

struct Supervoxels {
  std::vector<std::uint32_t> labels;  ///< Per entry of the tile.
  SupervoxelTable table;
};

struct SupervoxelShape {
  double cell = 26.0;  ///< Side of the cells that cut faces into supervoxels, spacings.
  double voxel = 2.0;  ///< Spacings.
  /// All points of a voxel belong to one supervoxel, as after clustering: borders between them are steps of voxels.
  bool whole_voxels = false;
};

/// The table of given labels. Adjacent are those with points in the same or in neighbouring voxels of `voxel` steps.
SupervoxelTable table_of(std::span<const LatticePoint> positions, const std::vector<std::uint32_t>& labels,
                         std::int32_t voxel);

/// One supervoxel per face of the scene and cell of an absolute grid.
Supervoxels supervoxels_of(const Scene& scene, const TilePoints& tile, double step, const SupervoxelShape& shape);

/// One supervoxel per cube of `cell` steps, whatever is in it.
Supervoxels cubic_supervoxels(std::span<const LatticePoint> positions, std::int32_t cell, std::int32_t voxel);

}  // namespace arris::test
