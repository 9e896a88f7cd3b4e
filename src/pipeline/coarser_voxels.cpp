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
constexpr std::size_t kBatchPoints = 4 * 1024;

/// The lattice point that the centroid of a voxel lies on or just above.
LatticePoint centroid_point(const VoxelGrid& grid, const Voxel& voxel) {
  const auto along = [&](int axis) {
    return static_cast<std::int32_t>(grid.corner(voxel.key[axis]) +
                                     voxel.centroid[static_cast<std::size_t>(axis)] / kVoxelFractions);
  };
  return {along(0), along(1), along(2)};
}

/// Calls use(voxel, rank) for the voxels without cluster in the cores of all tiles.
template <class Use>
void for_each_leftover(const tiling::VoxelStore& store, const tiling::TilePlan& tiles,
                       std::span<const std::uint32_t> clusters_of, const CancelToken& cancel, Use&& use) {
  for (const tiling::PlannedTile& tile : tiles.tiles) {
    cancel.check();
    store.for_each_stretch(tile.core, [&](std::span<const Voxel> voxels, std::uint32_t rank) {
      for (const Voxel& voxel : voxels) {
        if (clusters_of[rank] == kNoCluster && tile.core.contains(voxel.key)) use(voxel, rank);
        ++rank;
      }
    });
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
  const auto add = [&] {
    accumulator.add(points, point_colours);
    points.clear();
    point_colours.clear();
  };
  for_each_leftover(store, tiles, clusters_of, cancel, [&](const Voxel& voxel, std::uint32_t) {
    points.push_back(centroid_point(store.grid(), voxel));
    if (colours) point_colours.push_back(voxel.colour);
    if (points.size() == kBatchPoints) add();
  });
  add();
  return accumulator.finish();
}

void inherit_clusters(const tiling::VoxelStore& store, const tiling::TilePlan& tiles, const tiling::VoxelStore& coarse,
                      std::span<const std::uint32_t> coarse_clusters, std::uint32_t first,
                      std::span<std::uint32_t> clusters_of, const CancelToken& cancel) {
  std::uint32_t hint = 0;
  for_each_leftover(store, tiles, clusters_of, cancel, [&](const Voxel& voxel, std::uint32_t rank) {
    const LatticePoint key = coarse.grid().voxel_of(centroid_point(store.grid(), voxel));
    clusters_of[rank] = first + coarse_clusters[coarse.index().rank(key, hint)];
  });
}

}  // namespace arris::pipeline
