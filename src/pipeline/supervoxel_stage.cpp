#include "pipeline/supervoxel_stage.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "core/pages.h"
#include "core/parallel.h"
#include "features/supervoxel/clusters.h"
#include "pipeline/cluster_level.h"
#include "pipeline/coarser_voxels.h"
#include "tiling/voxel_neighbours.h"

namespace arris::pipeline {
namespace {

constexpr std::size_t kGrainBlocks = 2048;
constexpr std::size_t kGrainVoxels = 64 * 1024;

/// Takes turns with coarser voxels until every voxel of `walk` has a cluster.
ClusterLevel cluster_all(VoxelTileWalk& walk, const SupervoxelStageRequest& request, std::uint64_t kept_bytes,
                         ProgressSink& progress, const CancelToken& cancel) {
  const TileWalkRequest& here = walk.request();
  const bool coarsest = !can_coarsen(here.scale);
  ClusterLevel level = cluster_level(walk, coarsest, kept_bytes, progress);
  walk.drop();
  if (coarsest || std::ranges::find(level.clusters_of, kNoCluster) == level.clusters_of.end()) return level;
  const std::uint64_t here_bytes = kept_bytes + sizeof(std::uint32_t) * level.clusters_of.size();
  // Half of what is left: the other half is for reading these voxels.
  const std::uint64_t left_bytes = here.memory_bytes > here_bytes ? here.memory_bytes - here_bytes : 0;
  const tiling::VoxelStore coarse =
      coarser_voxels(walk.store(), walk.tiles(), level.clusters_of, here.colours, here.folder, left_bytes / 2, cancel);
  TileWalkRequest there = here;
  there.scale = coarser(here.scale, here.parameters);
  VoxelTileWalk coarse_walk(coarse, there, progress, cancel);
  const std::uint64_t kept = here_bytes + coarse.index().memory_bytes();
  const ClusterLevel coarse_level = cluster_all(coarse_walk, request, kept, progress, cancel);
  inherit_clusters(walk.store(), walk.tiles(), coarse, coarse_level.clusters_of, level.count, level.clusters_of,
                   cancel);
  level.count += coarse_level.count;
  level.groups = coarse_level.groups;
  level.predicted_bytes = std::max(level.predicted_bytes, coarse_level.predicted_bytes);
  return level;
}

/// Ids of clusters from 1 on; 0 where there are no voxels. @param count  set to how many have any.
PageVector<std::uint32_t> ids_by_first_rank(const ClusterLevel& level, std::uint32_t& count) {
  PageVector<std::uint32_t> first(level.count, kNoCluster);
  parallel_for_chunks(level.clusters_of.size(), kGrainVoxels, [&](std::size_t begin, std::size_t end) {
    std::uint32_t last = kNoCluster;
    for (auto rank = static_cast<std::uint32_t>(begin); rank < end; ++rank) {
      const std::uint32_t cluster = level.clusters_of[rank];
      if (cluster == last) continue;  // Ranks ascend.
      last = cluster;
      const std::atomic_ref<std::uint32_t> known(first[cluster]);
      std::uint32_t before = known.load(std::memory_order_relaxed);
      while (rank < before && !known.compare_exchange_weak(before, rank, std::memory_order_relaxed)) {
      }
    }
  });
  PageVector<std::uint64_t> ranks;  // And their clusters, below.
  ranks.reserve(first.size());
  for (std::uint32_t cluster = 0; cluster < first.size(); ++cluster) {
    if (first[cluster] != kNoCluster) ranks.push_back(std::uint64_t{first[cluster]} << 32 | cluster);
  }
  std::ranges::sort(ranks);
  PageVector<std::uint32_t> ids = std::move(first);
  std::ranges::fill(ids, 0U);
  for (const std::uint64_t rank : ranks) ids[static_cast<std::uint32_t>(rank)] = ++count;
  return ids;
}

class Stage {
 public:
  Stage(const tiling::VoxelStore& store, const SupervoxelStageRequest& request, ProgressSink& progress,
        const CancelToken& cancel)
      : request_(request), progress_(progress), cancel_(cancel), walk_(store, request.walk, progress, cancel) {}

  SupervoxelStageResult run() {
    ClusterLevel level = cluster_all(walk_, request_, 0, progress_, cancel_);
    result_.tiles = walk_.tiles().tiles.size();
    result_.largest_tile_voxels = walk_.largest_tile_voxels();
    result_.predicted_bytes = level.predicted_bytes;
    result_.normals_bytes_on_disk = walk_.normals_bytes_on_disk();
    number(level);
    look_at_neighbours(level.seed_ranks);
    return std::move(result_);
  }

 private:
  /// Dense ids in the order of the first ranks, in place.
  void number(ClusterLevel& level) {
    const PageVector<std::uint32_t> id_of = ids_by_first_rank(level, result_.count);
    parallel_for_chunks(level.clusters_of.size(), kGrainVoxels, [&](std::size_t begin, std::size_t end) {
      for (std::size_t rank = begin; rank < end; ++rank) level.clusters_of[rank] = id_of[level.clusters_of[rank]];
    });
    result_.ids = std::move(level.clusters_of);
    result_.planes.resize(std::size_t{result_.count} + 1);
    for (std::size_t cluster = 0; cluster < level.planes.size(); ++cluster)
      result_.planes[id_of[cluster]] = level.planes[cluster];
    result_.groups = level.groups;
    result_.coarse = level.count - static_cast<std::uint32_t>(level.planes.size()) - level.lone;
  }

  /// Pairs of neighbours, and voxels that several surfaces share.
  void look_at_neighbours(const std::vector<std::uint32_t>& seed_ranks) {
    progress_.phase("neighbours", result_.ids.size());
    result_.shared.assign((result_.ids.size() + 63) / 64, 0);
    const tiling::VoxelIndex& index = walk_.store().index();
    std::mutex mutex;
    parallel_for_chunks(index.blocks(), kGrainBlocks, [&](std::size_t begin, std::size_t end) {
      cancel_.check();
      Pairs found;
      std::uint64_t voxels = 0;
      tiling::for_each_neighbourhood(index, begin, end, [&](std::uint32_t rank, std::span<const std::uint32_t> around) {
        look_around(rank, around, found);
        ++voxels;
      });
      make_unique(found);
      const std::lock_guard lock(mutex);
      result_.adjacency.insert(result_.adjacency.end(), found.begin(), found.end());
      progress_.advance(voxels);
    });
    make_unique(result_.adjacency);
    // Every supervoxel keeps at least the points of one voxel.
    for (const std::uint32_t rank : seed_ranks) result_.shared[rank >> 6] &= ~(std::uint64_t{1} << (rank & 63));
  }

  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  static void make_unique(Pairs& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

  void look_around(std::uint32_t rank, std::span<const std::uint32_t> neighbours, Pairs& pairs) {
    const std::uint32_t id = result_.ids[rank];
    std::uint32_t last = id;
    bool shared = false;
    for (const std::uint32_t neighbour : neighbours) {
      const std::uint32_t other = result_.ids[neighbour];
      if (other == id || other == last) continue;
      last = other;
      if (request_.adjacency) pairs.emplace_back(std::min(id, other), std::max(id, other));
      shared = shared || planes_differ(result_.planes[id], result_.planes[other], request_.walk.scale.voxel_steps);
    }
    if (!shared) return;
    // Voxels of other chunks have bits in the same word.
    std::atomic_ref<std::uint64_t>(result_.shared[rank >> 6])
        .fetch_or(std::uint64_t{1} << (rank & 63), std::memory_order_relaxed);
  }

  const SupervoxelStageRequest& request_;
  ProgressSink& progress_;
  const CancelToken& cancel_;
  VoxelTileWalk walk_;
  SupervoxelStageResult result_;
};

}  // namespace

SupervoxelStageResult run_supervoxel_stage(const tiling::VoxelStore& store, const SupervoxelStageRequest& request,
                                           ProgressSink& progress, const CancelToken& cancel) {
  return Stage(store, request, progress, cancel).run();
}

}  // namespace arris::pipeline
