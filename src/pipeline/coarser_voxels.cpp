#include "pipeline/coarser_voxels.h"

#include <algorithm>
#include <string>
#include <vector>

#include "features/supervoxel/clusters.h"
#include "tiling/voxel_accumulator.h"

namespace arris::pipeline {
namespace {

constexpr std::uint64_t kLeastTableBytes = 1024 * 1024;
constexpr std::uint64_t kMostTableBytes = 64 * 1024 * 1024;

/// The lattice point that the centroid of a voxel lies on or just above.
LatticePoint centroid_point(const VoxelGrid& grid, const Voxel& voxel) {
  const auto along = [&](int axis) {
    return static_cast<std::int32_t>(grid.corner(voxel.key[axis]) +
                                     voxel.centroid[static_cast<std::size_t>(axis)] / kVoxelFractions);
  };
  return {along(0), along(1), along(2)};
}

/// Calls use(voxels, ranks) for the cores of all tiles.
template <class Use>
void for_each_core(const tiling::VoxelStore& store, const tiling::TilePlan& tiles, const CancelToken& cancel,
                   Use&& use) {
  std::vector<Voxel> voxels;
  std::vector<std::uint32_t> ranks;
  for (const tiling::PlannedTile& tile : tiles.tiles) {
    cancel.check();
    store.load(tile.core, voxels, ranks);
    use(voxels, ranks);
  }
}

}  // namespace

bool can_coarsen(const SupervoxelScale& scale) {
  return 4 * std::int64_t{scale.voxel_steps} <= scale.seed_steps && 2 * scale.voxel_steps <= kMostVoxelSide;
}

SupervoxelScale coarser(const SupervoxelScale& scale, const SupervoxelParameters& parameters) {
  return make_scale(2 * scale.voxel_steps, scale.seed_steps, parameters);
}

tiling::VoxelStore coarser_voxels(const tiling::VoxelStore& store, const tiling::TilePlan& tiles,
                                  std::span<const std::uint32_t> clusters_of, bool colours,
                                  const std::filesystem::path& folder, std::uint64_t memory_bytes,
                                  const CancelToken& cancel) {
  const std::int32_t side_steps = 2 * store.grid().side_steps();
  const std::filesystem::path own_folder = folder / ("voxels-" + std::to_string(side_steps));
  std::filesystem::create_directory(own_folder);
  const std::uint64_t table_bytes = std::clamp(memory_bytes / 4, kLeastTableBytes, kMostTableBytes);
  const std::uint64_t index_bytes = memory_bytes > table_bytes ? memory_bytes - table_bytes : 0;
  tiling::VoxelAccumulator accumulator(VoxelGrid(side_steps), {own_folder, table_bytes, index_bytes});
  std::vector<LatticePoint> points;
  std::vector<RawColour> point_colours;
  for_each_core(store, tiles, cancel, [&](const std::vector<Voxel>& voxels, const std::vector<std::uint32_t>& ranks) {
    points.clear();
    point_colours.clear();
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      if (clusters_of[ranks[i]] != kNoCluster) continue;
      points.push_back(centroid_point(store.grid(), voxels[i]));
      if (colours) point_colours.push_back(voxels[i].colour);
    }
    accumulator.add(points, point_colours);
  });
  return accumulator.finish();
}

void inherit_clusters(const tiling::VoxelStore& store, const tiling::TilePlan& tiles, const tiling::VoxelStore& coarse,
                      std::span<const std::uint32_t> coarse_clusters, std::uint32_t first,
                      std::span<std::uint32_t> clusters_of, const CancelToken& cancel) {
  for_each_core(store, tiles, cancel, [&](const std::vector<Voxel>& voxels, const std::vector<std::uint32_t>& ranks) {
    std::uint32_t hint = 0;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      std::uint32_t& cluster = clusters_of[ranks[i]];
      if (cluster != kNoCluster) continue;
      const LatticePoint key = coarse.grid().voxel_of(centroid_point(store.grid(), voxels[i]));
      cluster = first + coarse_clusters[coarse.index().rank(key, hint)];
    }
  });
}

}  // namespace arris::pipeline
