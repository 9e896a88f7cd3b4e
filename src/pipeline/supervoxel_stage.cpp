#include "pipeline/supervoxel_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "core/error.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "features/cluster_growth.h"
#include "features/leftover_voxels.h"
#include "features/seed_cells.h"
#include "features/voxel_features.h"
#include "merge/cluster_table.h"
#include "tiling/voxel_tiles.h"

namespace arris::pipeline {
namespace {

/// Full intensity of the colours of voxels.
constexpr double kFullColour = 65535.0;
/// Bytes of a cluster in all tables, for predictions before the clusters are known.
constexpr double kClusterBytes = 300.0;
constexpr double kClusterHistogramBytes = 400.0;
/// A tile may not be cut below this many voxels.
constexpr std::uint64_t kLeastTileVoxels = 20'000;

struct LoadedTile {
  VoxelTile voxels;
  VoxelFeatures features;
};

class Stage {
 public:
  Stage(const tiling::VoxelStore& store, const SupervoxelStageRequest& request, ProgressSink& progress,
        const CancelToken& cancel)
      : store_(store), request_(request), progress_(progress), cancel_(cancel), table_(request.parameters) {}

  SupervoxelStageResult run() {
    result_.ids.assign(store_.size(), kNoCluster);
    if (store_.size() == 0) return std::move(result_);
    const double cells = static_cast<double>(request_.scale.seed_steps) / request_.scale.voxel_steps;
    const auto likely_clusters = static_cast<std::uint64_t>(2.0 * store_.size() / (cells * cells)) + 1000;
    plan(likely_clusters * static_cast<std::uint64_t>(cluster_bytes()));
    find_all_seeds();
    if (table_.memory_bytes() > likely_clusters * static_cast<std::uint64_t>(cluster_bytes()))
      plan(table_.memory_bytes());
    for (int iteration = 1; iteration <= request_.parameters.iterations; ++iteration) grow(iteration);
    number();
    if (request_.adjacency || request_.refine) look_at_neighbours();
    return std::move(result_);
  }

 private:
  double cluster_bytes() const { return kClusterBytes + (fpfh() ? kClusterHistogramBytes : 0.0); }
  bool fpfh() const { return request_.parameters.features == SupervoxelParameters::Features::kFpfh; }

  void plan(std::uint64_t table_bytes) {
    const double each = supervoxel_bytes_per_voxel(request_.parameters.features, request_.colours);
    const std::uint64_t kept = table_bytes + sizeof(std::uint32_t) * std::uint64_t{store_.size()};
    const std::uint64_t room = request_.memory_bytes > kept ? request_.memory_bytes - kept : 0;
    tiling::VoxelPlanRequest tiles;
    tiles.max_voxels = std::max(kLeastTileVoxels, static_cast<std::uint64_t>(static_cast<double>(room) / each));
    tiles.max_core_voxels = request_.tile_voxels_cap;
    tiles.halo_voxels = request_.scale.halo_voxels();
    plan_ = tiling::plan_voxel_tiles(store_.index(), tiles);
    loaded_.reset();
    result_.tiles = plan_.tiles.size();
    result_.largest_tile_voxels = std::min<std::uint64_t>(plan_.largest_covered_points, store_.size());
    const auto tile_bytes = static_cast<std::uint64_t>(each * static_cast<double>(result_.largest_tile_voxels));
    result_.predicted_bytes = kept + tile_bytes;
    if (result_.predicted_bytes > request_.memory_bytes) {
      throw BudgetError(
          fmt::format("{} voxels and their supervoxels need {} more memory than --memory leaves; raise it, or "
                      "choose larger --voxel or smaller --seed",
                      grouped(store_.size()), human_bytes(result_.predicted_bytes - request_.memory_bytes)));
    }
  }

  /// Calls use(tile) for every tile; features only where they are needed.
  template <class Use>
  void for_each_tile(bool features, Use&& use) {
    for (std::size_t i = 0; i < plan_.tiles.size(); ++i) {
      cancel_.check();
      if (plan_.tiles.size() > 1 || !loaded_) {
        loaded_.reset();
        release_free_memory();
        loaded_.emplace(LoadedTile{tiling::load_voxel_tile(store_, plan_.tiles[i], request_.colours), {}});
      }
      if (features && loaded_->features.normals.empty())
        loaded_->features = voxel_features(loaded_->voxels, request_.parameters, kFullColour);
      use(*loaded_);
      progress_.advance(plan_.tiles[i].core_points);
    }
    if (plan_.tiles.size() > 1) loaded_.reset();
  }

  void find_all_seeds() {
    progress_.phase("seeds", store_.size());
    for_each_tile(true, [&](const LoadedTile& tile) {
      table_.add_seeds(tile.voxels, tile.features, find_seeds(tile.voxels, request_.scale));
    });
    table_.fix_seeds();
  }

  /// One iteration: what clusters won is kept by rank, then their centres and seeds move.
  void grow(int iteration) {
    const bool last = iteration == request_.parameters.iterations;
    progress_.phase("supervoxels", store_.size());
    for_each_tile(true, [&](const LoadedTile& tile) {
      const std::vector<TileSeed> seeds = tile_seeds(tile.voxels, table_.clusters(), table_.by_seed_rank());
      std::vector<std::uint32_t> clusters_of =
          grow_clusters(tile.voxels, tile.features, table_.clusters(), seeds, request_.parameters, request_.scale);
      if (last) {
        const std::vector<OrphanVoxel> orphans = settle_leftovers(tile.voxels, tile.features, table_.clusters(),
                                                                  request_.parameters, request_.scale, clusters_of);
        orphans_.insert(orphans_.end(), orphans.begin(), orphans.end());
      }
      table_.add_members(tile.voxels, tile.features, clusters_of);
      for (std::size_t v = 0; v < clusters_of.size(); ++v) {
        if (tile.voxels.core[v] != 0) result_.ids[tile.voxels.ranks[v]] = clusters_of[v];
      }
    });
    if (last) return;
    table_.update_centres();
    for_each_tile(false, [&](const LoadedTile& tile) {
      std::vector<std::uint32_t> clusters_of(tile.voxels.size());
      for (std::size_t v = 0; v < clusters_of.size(); ++v) clusters_of[v] = result_.ids[tile.voxels.ranks[v]];
      table_.offer_seeds(tile.voxels, clusters_of);
    });
    table_.move_seeds();
  }

  /// Dense ids in the order of ranks; leftover groups take part by their smallest rank.
  void number() {
    const std::uint32_t clusters = table_.clusters().size();
    std::sort(orphans_.begin(), orphans_.end(),
              [](const OrphanVoxel& a, const OrphanVoxel& b) { return a.rank < b.rank; });
    std::vector<std::uint32_t> id_of(clusters, 0);
    std::unordered_map<std::uint32_t, std::uint32_t> id_of_root;
    auto orphan = orphans_.begin();
    for (std::uint32_t rank = 0; rank < store_.size(); ++rank) {
      const std::uint32_t cluster = result_.ids[rank];
      if (cluster != kNoCluster) {
        if (id_of[cluster] == 0) id_of[cluster] = ++result_.count;
        result_.ids[rank] = id_of[cluster];
        continue;
      }
      if (orphan == orphans_.end() || orphan->rank != rank)
        throw IoError("internal: a voxel belongs to no tile; please report this");
      const auto [found, fresh] = id_of_root.try_emplace(orphan->root_rank, result_.count + 1);
      if (fresh) {
        ++result_.count;
        ++result_.orphans;
      }
      result_.ids[rank] = found->second;
      ++orphan;
    }
    orphans_ = {};
    result_.planes.resize(std::size_t{result_.count} + 1);
    const std::vector<ClusterPlane> planes = table_.planes();
    for (std::uint32_t cluster = 0; cluster < clusters; ++cluster) result_.planes[id_of[cluster]] = planes[cluster];
  }

  /// Pairs of neighbours, and voxels that several surfaces share.
  void look_at_neighbours() {
    progress_.phase("neighbours", store_.size());
    if (request_.refine) result_.shared.assign((std::size_t{store_.size()} + 63) / 64, 0);
    auto& pairs = result_.adjacency;
    for_each_tile(false, [&](const LoadedTile& tile) {
      for (std::size_t v = 0; v < tile.voxels.size(); ++v) {
        if (tile.voxels.core[v] != 0) look_around(tile.voxels, v);
      }
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    });
    // Every supervoxel keeps at least the points of one voxel.
    if (request_.refine) {
      for (const std::uint32_t rank : table_.clusters().seed_ranks)
        result_.shared[rank >> 6] &= ~(std::uint64_t{1} << (rank & 63));
    }
  }

  void look_around(const VoxelTile& tile, std::size_t v) {
    const std::uint32_t rank = tile.ranks[v];
    const std::uint32_t id = result_.ids[rank];
    std::uint32_t last = id;
    for (const std::uint32_t u : tile.neighbours_of(v)) {
      const std::uint32_t other = result_.ids[tile.ranks[u]];
      if (other == id || other == last) continue;
      last = other;
      if (request_.adjacency) result_.adjacency.emplace_back(std::min(id, other), std::max(id, other));
      if (request_.refine && planes_differ(result_.planes[id], result_.planes[other], request_.scale.voxel_steps))
        result_.shared[rank >> 6] |= std::uint64_t{1} << (rank & 63);
    }
  }

  const tiling::VoxelStore& store_;
  const SupervoxelStageRequest& request_;
  ProgressSink& progress_;
  const CancelToken& cancel_;
  merge::ClusterTable table_;
  tiling::TilePlan plan_;
  std::optional<LoadedTile> loaded_;
  std::vector<OrphanVoxel> orphans_;
  SupervoxelStageResult result_;
};

}  // namespace

SupervoxelStageResult run_supervoxel_stage(const tiling::VoxelStore& store, const SupervoxelStageRequest& request,
                                           ProgressSink& progress, const CancelToken& cancel) {
  return Stage(store, request, progress, cancel).run();
}

}  // namespace arris::pipeline
