#include "tiling/voxel_tiles.h"

#include <algorithm>
#include <span>

#include "tiling/voxel_neighbours.h"

namespace arris::tiling {
namespace {

constexpr int kBlockLevel = 3;  // Of VoxelIndex.
/// A cell with more than 1/64 of the voxels of a tile makes halos too large, which hold whole cells.
constexpr std::uint64_t kCellsOfATile = 64;

}  // namespace

TilePlan plan_voxel_tiles(const VoxelIndex& index, const VoxelPlanRequest& request) {
  Survey voxels;  // Voxels take the place of points, one to a step.
  voxels.lattice = {1.0, {0.0, 0.0, 0.0}};
  voxels.bounds = index.bounds();
  voxels.points_in = index.size();
  voxels.spacing = 1.0;
  voxels.counts = CellCounts(kBlockLevel);
  const auto add_blocks = [&](const PlanCells::Add& add) {
    for (std::size_t i = 0; i < index.blocks(); ++i) {
      const VoxelIndex::Block block = index.block(i);
      const LatticePoint corner{block.key.x * (1 << kBlockLevel), block.key.y * (1 << kBlockLevel),
                                block.key.z * (1 << kBlockLevel)};
      add({&corner, 1}, block.voxels);
    }
  };
  add_blocks(
      [&](std::span<const LatticePoint> corners, std::uint64_t count) { voxels.counts.add(corners.front(), count); });
  PlanRequest plan;
  plan.max_points = request.max_voxels;
  plan.max_core_points = request.max_core_voxels;
  plan.max_radius = std::max(1, request.halo_voxels);
  plan.whole_halo = true;
  plan.halo = [&](double) { return static_cast<double>(request.halo_voxels); };
  PlanCells cells(voxels, plan.max_points / kCellsOfATile, kBlockLevel);
  TilePlan tiles = plan_tiles(cells, plan);
  while (tiles.largest_covered_points > plan.max_points && cells.refine(add_blocks)) tiles = plan_tiles(cells, plan);
  return tiles;
}

VoxelTile load_voxels(const VoxelStore& store, const PlannedTile& planned, bool colours) {
  VoxelTile tile(store.grid());
  const std::size_t most = store.most_voxels(planned.covered);
  tile.keys.reserve(most);
  tile.positions.reserve(most);
  tile.ranks.reserve(most);
  tile.core.reserve(most);
  if (colours) tile.colours.reserve(most);
  const auto position = [&](const Voxel& voxel) {
    VoxelPosition at;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t corner = kVoxelFractions * store.grid().corner(voxel.key[axis]);
      at[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(static_cast<std::uint64_t>(corner)) +
                                           voxel.centroid[static_cast<std::size_t>(axis)];
    }
    return at;
  };
  store.for_each_stretch(planned.covered, [&](std::span<const Voxel> voxels, std::uint32_t rank) {
    for (const Voxel& voxel : voxels) {
      if (planned.covered.contains(voxel.key)) {
        tile.keys.push_back(voxel.key);
        tile.positions.push_back(position(voxel));
        tile.ranks.push_back(rank);
        tile.core.push_back(planned.core.contains(voxel.key) ? 1 : 0);
        if (colours) tile.colours.push_back(voxel.colour);
      }
      ++rank;
    }
  });
  return tile;
}

VoxelTile load_voxel_tile(const VoxelStore& store, const PlannedTile& planned, bool colours) {
  VoxelTile tile = load_voxels(store, planned, colours);
  if (tile.size() == store.size()) {
    link_neighbours(tile, store.index());
  } else {
    VoxelIndex index;
    for (const LatticePoint& key : tile.keys) index.append(key);
    index.finish();
    link_neighbours(tile, index);
  }
  return tile;
}

}  // namespace arris::tiling
