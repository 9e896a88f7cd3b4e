#include "pipeline/coarser_voxels.h"

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "features/supervoxel/clusters.h"
#include "tiling/voxel_accumulator.h"

namespace arris::pipeline {
namespace {

constexpr std::uint64_t kLeastTableBytes = 1024 * 1024;
constexpr std::uint64_t kMostTableBytes = 64 * 1024 * 1024;
constexpr std::size_t kGrainStretches = 2;

/// The lattice point that the centroid of a voxel lies on or just above.
LatticePoint centroid_point(const VoxelGrid& grid, const Voxel& voxel) {
  const auto along = [&](int axis) {
    return static_cast<std::int32_t>(grid.corner(voxel.key[axis]) +
                                     voxel.centroid[static_cast<std::size_t>(axis)] / kVoxelFractions);
  };
  return {along(0), along(1), along(2)};
}

/// Voxels without cluster, and their ranks.
struct Leftovers {
  std::vector<Voxel> voxels;
  std::vector<std::uint32_t> ranks;
};

/// Calls use(leftovers of a stretch of ranks) for the cores of all tiles, in no order and several at a time.
template <class Use>
void for_each_leftovers(const tiling::VoxelStore& store, const tiling::TilePlan& tiles,
                        std::span<const std::uint32_t> clusters_of, const CancelToken& cancel, Use&& use) {
  for (const tiling::PlannedTile& tile : tiles.tiles) {
    cancel.check();
    const std::vector<tiling::RankRange> stretches = store.stretches(tile.core);
    parallel_for_chunks(stretches.size(), kGrainStretches, [&](std::size_t begin, std::size_t end) {
      std::vector<Voxel> read;
      Leftovers found;
      for (const tiling::RankRange& stretch : std::span(stretches).subspan(begin, end - begin)) {
        store.read(stretch.begin, stretch.end, read);
        found.voxels.clear();
        found.ranks.clear();
        for (std::uint32_t rank = stretch.begin; rank < stretch.end; ++rank) {
          const Voxel& voxel = read[rank - stretch.begin];
          if (clusters_of[rank] != kNoCluster || !tile.core.contains(voxel.key)) continue;
          found.voxels.push_back(voxel);
          found.ranks.push_back(rank);
        }
        use(found);
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
  std::mutex mutex;  // Of the accumulator, which takes points in any order.
  for_each_leftovers(store, tiles, clusters_of, cancel, [&](const Leftovers& found) {
    std::vector<LatticePoint> points;
    std::vector<RawColour> point_colours;
    points.reserve(found.voxels.size());
    for (const Voxel& voxel : found.voxels) {
      points.push_back(centroid_point(store.grid(), voxel));
      if (colours) point_colours.push_back(voxel.colour);
    }
    const std::lock_guard lock(mutex);
    accumulator.add(points, point_colours);
  });
  return accumulator.finish();
}

void inherit_clusters(const tiling::VoxelStore& store, const tiling::TilePlan& tiles, const tiling::VoxelStore& coarse,
                      std::span<const std::uint32_t> coarse_clusters, std::uint32_t first,
                      std::span<std::uint32_t> clusters_of, const CancelToken& cancel) {
  for_each_leftovers(store, tiles, clusters_of, cancel, [&](const Leftovers& found) {
    std::uint32_t hint = 0;
    for (std::size_t i = 0; i < found.voxels.size(); ++i) {
      const LatticePoint key = coarse.grid().voxel_of(centroid_point(store.grid(), found.voxels[i]));
      clusters_of[found.ranks[i]] = first + coarse_clusters[coarse.index().rank(key, hint)];
    }
  });
}

}  // namespace arris::pipeline
