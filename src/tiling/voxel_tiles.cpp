#include "tiling/voxel_tiles.h"

#include <algorithm>

#include "core/parallel.h"
#include "tiling/voxel_neighbours.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kGrain = 16 * 1024;
constexpr int kBlockLevel = 3;  // Of VoxelIndex.
}  // namespace

TilePlan plan_voxel_tiles(const VoxelIndex& index, const VoxelPlanRequest& request) {
  Survey voxels;  // Voxels take the place of points, one to a step.
  voxels.lattice = {1.0, {0.0, 0.0, 0.0}};
  voxels.bounds = index.bounds();
  voxels.points_in = index.size();
  voxels.spacing = 1.0;
  voxels.counts = CellCounts(kBlockLevel);
  for (std::size_t i = 0; i < index.blocks(); ++i) {
    const VoxelIndex::Block block = index.block(i);
    const LatticePoint corner{block.key.x * (1 << kBlockLevel), block.key.y * (1 << kBlockLevel),
                              block.key.z * (1 << kBlockLevel)};
    voxels.counts.add(corner, block.voxels);
  }
  PlanRequest plan;
  plan.max_points = request.max_voxels;
  plan.max_core_points = request.max_core_voxels;
  plan.max_radius = std::max(1, request.halo_voxels);
  plan.whole_halo = true;
  plan.halo = [&](double) { return static_cast<double>(request.halo_voxels); };
  return plan_tiles(voxels, plan);
}

VoxelTile load_voxel_tile(const VoxelStore& store, const PlannedTile& planned, bool colours) {
  VoxelTile tile(store.grid());
  std::vector<Voxel> voxels;
  store.load(planned.covered, voxels, tile.ranks);
  const std::size_t count = voxels.size();
  tile.keys.resize(count);
  tile.positions.resize(count);
  tile.core.resize(count);
  if (colours) tile.colours.resize(count);
  parallel_for_chunks(count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const LatticePoint& key = voxels[v].key;
      tile.keys[v] = key;
      for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t corner = kVoxelFractions * store.grid().corner(key[axis]);
        tile.positions[v][static_cast<std::size_t>(axis)] =
            static_cast<std::uint32_t>(static_cast<std::uint64_t>(corner)) +
            voxels[v].centroid[static_cast<std::size_t>(axis)];
      }
      tile.core[v] = planned.core.contains(key) ? 1 : 0;
      if (colours) tile.colours[v] = voxels[v].colour;
    }
  });
  voxels = {};
  if (count == store.size()) {
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
