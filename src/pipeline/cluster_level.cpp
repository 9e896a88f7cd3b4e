#include "pipeline/cluster_level.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "core/parallel.h"
#include "features/supervoxel/cluster_growth.h"
#include "features/supervoxel/leftover_voxels.h"
#include "features/supervoxel/seed_cells.h"
#include "merge/cluster_table.h"

namespace arris::pipeline {
namespace {

constexpr std::size_t kGrain = 64 * 1024;
constexpr double kClusterBytes = 280.0;
constexpr double kClusterHistogramBytes = 400.0;

class Clustering {
 public:
  Clustering(VoxelTileWalk& walk, bool group_leftovers, ProgressSink& progress)
      : walk_(walk),
        group_leftovers_(group_leftovers),
        parameters_(walk.request().parameters),
        scale_(walk.request().scale),
        progress_(progress),
        table_(parameters_) {}

  ClusterLevel run(std::uint64_t kept_bytes) {
    const std::uint32_t voxels = walk_.store().size();
    level_.clusters_of.assign(voxels, kNoCluster);
    if (voxels == 0) return std::move(level_);
    lone_.assign((voxels + 63) / 64, 0);
    kept_bytes += sizeof(std::uint32_t) * std::uint64_t{voxels} + voxels / 8;
    const std::uint64_t likely = likely_clusters();
    const auto each = static_cast<std::uint64_t>(cluster_bytes(parameters_));
    walk_.plan(kept_bytes + likely * each);
    if (const std::uint64_t seeds = find_seeds_up_to(likely); seeds > likely) {
      // Tiles must leave them their room.
      walk_.plan(kept_bytes + seeds * each);
      find_seeds_up_to(seeds);
    }
    table_.fix_seeds();
    for (int iteration = 1; iteration < parameters_.iterations; ++iteration) {
      grow(false);
      table_.update_centres();
      move_seeds();
    }
    grow(true);
    level_.count = table_.clusters().size();
    level_.planes = table_.planes();
    level_.seed_ranks = table_.clusters().seed_ranks;
    level_.predicted_bytes = walk_.predicted_bytes();
    number_lone();
    if (group_leftovers_) number_groups();
    return std::move(level_);
  }

 private:
  /// Voxels that have a block of the index to themselves are lone, most of them.
  std::uint64_t likely_clusters() const {
    const tiling::VoxelIndex& index = walk_.store().index();
    std::uint64_t together = 0;
    for (std::size_t i = 0; i < index.blocks(); ++i) together += index.block(i).voxels > 1 ? index.block(i).voxels : 0;
    return static_cast<std::uint64_t>(pipeline::likely_clusters(static_cast<double>(together), scale_));
  }

  /// Puts all seeds into the table if there are no more than `most`, else none. Returns how many there are.
  std::uint64_t find_seeds_up_to(std::uint64_t most) {
    progress_.phase("seeds", walk_.store().size());
    std::uint64_t seeds = 0;
    walk_.for_each(TileView::kFeatures, [&](const LoadedTile& tile) {
      std::vector<Seed> found = find_seeds(tile.voxels, scale_);
      set_lone_apart(tile.voxels, found);
      seeds += found.size();
      if (seeds <= most) table_.add_seeds(tile.voxels, tile.features, found);
    });
    if (seeds > most) table_.drop_seeds();
    return seeds;
  }

  /// Seeds without neighbours are all that their clusters will ever be: they need no place in the table.
  void set_lone_apart(const VoxelTile& tile, std::vector<Seed>& seeds) {
    std::erase_if(seeds, [&](const Seed& seed) {
      const bool lone = tile.neighbours_of(seed.voxel).empty();
      if (lone) lone_[tile.ranks[seed.voxel] >> 6] |= std::uint64_t{1} << (tile.ranks[seed.voxel] & 63);
      return lone;
    });
  }

  void grow(bool last) {
    progress_.phase("supervoxels", walk_.store().size());
    walk_.for_each(TileView::kFeatures, [&](const LoadedTile& tile) {
      const std::vector<TileSeed> seeds = tile_seeds(tile.voxels, table_.clusters(), table_.by_seed_rank());
      PageVector<std::uint32_t> clusters_of =
          grow_clusters(tile.voxels, tile.features, table_.clusters(), seeds, parameters_, scale_);
      if (last) {
        attach_leftovers(tile.voxels, tile.features, table_.clusters(), parameters_, scale_, clusters_of);
        if (group_leftovers_) keep_orphans(group_orphans(tile.voxels, scale_, clusters_of));
      }
      table_.add_members(tile.voxels, tile.features, clusters_of);
      parallel_for_chunks(clusters_of.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
          if (tile.voxels.core[v] != 0) level_.clusters_of[tile.voxels.ranks[v]] = clusters_of[v];
        }
      });
    });
  }

  void keep_orphans(const std::vector<OrphanVoxel>& orphans) {
    std::ranges::copy_if(orphans, std::back_inserter(orphans_), [&](const OrphanVoxel& orphan) {
      return (lone_[orphan.rank >> 6] >> (orphan.rank & 63) & 1) == 0;
    });
  }

  void move_seeds() {
    walk_.for_each(TileView::kCore, [&](const LoadedTile& tile) {
      PageVector<std::uint32_t> clusters_of(tile.voxels.size());
      parallel_for_chunks(clusters_of.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) clusters_of[v] = level_.clusters_of[tile.voxels.ranks[v]];
      });
      table_.offer_seeds(tile.voxels, clusters_of);
    });
    table_.move_seeds();
  }

  void number_lone() {
    for (std::size_t word = 0; word < lone_.size(); ++word) {
      for (std::uint64_t bits = lone_[word]; bits != 0; bits &= bits - 1) {
        level_.clusters_of[word * 64 + static_cast<std::size_t>(std::countr_zero(bits))] = level_.count + level_.lone++;
      }
    }
    level_.count += level_.lone;
  }

  /// Groups of leftovers are numbered after the clusters, by the smallest rank in each.
  void number_groups() {
    std::vector<std::uint32_t> roots;
    roots.reserve(orphans_.size());
    for (const OrphanVoxel& orphan : orphans_) roots.push_back(orphan.root_rank);
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    for (const OrphanVoxel& orphan : orphans_) {
      const auto at = std::lower_bound(roots.begin(), roots.end(), orphan.root_rank);
      level_.clusters_of[orphan.rank] = level_.count + static_cast<std::uint32_t>(at - roots.begin());
    }
    level_.groups = static_cast<std::uint32_t>(roots.size());
    level_.count += level_.groups;
  }

  VoxelTileWalk& walk_;
  bool group_leftovers_;  ///< Or leave them to coarser voxels.
  const SupervoxelParameters& parameters_;
  const SupervoxelScale& scale_;
  ProgressSink& progress_;
  merge::ClusterTable table_;
  std::vector<std::uint64_t> lone_;  ///< A bit by rank: a seed without neighbours.
  std::vector<OrphanVoxel> orphans_;
  ClusterLevel level_;
};

}  // namespace

double cluster_bytes(const SupervoxelParameters& parameters) {
  const bool histograms = parameters.features == SupervoxelParameters::Features::kFpfh;
  return kClusterBytes + (histograms ? kClusterHistogramBytes : 0.0);
}

double likely_clusters(double voxels, const SupervoxelScale& scale) {
  const double cells = static_cast<double>(scale.seed_steps) / scale.voxel_steps;
  return 2.0 * voxels / (cells * cells) + 1000.0;
}

ClusterLevel cluster_level(VoxelTileWalk& walk, bool group_leftovers, std::uint64_t kept_bytes,
                           ProgressSink& progress) {
  return Clustering(walk, group_leftovers, progress).run(kept_bytes);
}

}  // namespace arris::pipeline
