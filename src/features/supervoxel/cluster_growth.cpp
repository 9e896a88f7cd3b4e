#include "features/supervoxel/cluster_growth.h"

#include <atomic>
#include <bit>
#include <mutex>

#include "core/parallel.h"
#include "features/supervoxel/cluster_distance.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 1024;
constexpr std::uint64_t kFree = ~std::uint64_t{0};

/// Distances are not negative, so their bits sort as they do: the smaller offer is the smaller number.
std::uint64_t offer(float distance, std::uint32_t cluster) {
  return (std::uint64_t{std::bit_cast<std::uint32_t>(distance)} + 1) << 32 | cluster;
}
/// Below all offers: nothing takes a seed's own voxel, also where distances are 0.
std::uint64_t seed_state(std::uint32_t cluster) {
  return cluster;
}
std::uint32_t cluster_of(std::uint64_t state) {
  return static_cast<std::uint32_t>(state);
}

template <class Distance>
class Growth {
 public:
  Growth(const VoxelTile& tile, const Distance& distance)
      : tile_(tile), distance_(distance), state_(tile.size(), kFree), touched_(tile.size(), 0) {}

  void seed(std::span<const TileSeed> seeds) {
    for (const TileSeed& s : seeds) {
      state_[s.voxel] = seed_state(s.cluster);
      frontier_.push_back(s);
    }
  }

  /// One level: offers of the frontier, which then is what they won.
  void advance() {
    std::vector<std::uint32_t> won;
    std::mutex mutex;
    parallel_for_chunks(frontier_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> mine;
      for (std::size_t i = begin; i < end; ++i) make_offers(frontier_[i], mine);
      const std::lock_guard lock(mutex);
      won.insert(won.end(), mine.begin(), mine.end());
    });
    frontier_.clear();
    for (const std::uint32_t voxel : won) frontier_.push_back({voxel, cluster_of(state_[voxel])});
    parallel_for_chunks(won.size(), 64 * kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) touched_[won[i]] = 0;
    });
  }

  bool done() const { return frontier_.empty(); }

  std::vector<std::uint32_t> clusters() const {
    std::vector<std::uint32_t> result(state_.size());
    for (std::size_t v = 0; v < result.size(); ++v) result[v] = cluster_of(state_[v]);
    return result;
  }

 private:
  void make_offers(const TileSeed& from, std::vector<std::uint32_t>& won) {
    for (const std::uint32_t voxel : tile_.neighbours_of(from.voxel)) {
      std::atomic_ref<std::uint64_t> state(state_[voxel]);
      std::uint64_t now = state.load(std::memory_order_relaxed);
      if (now != kFree && cluster_of(now) == from.cluster) continue;
      const std::uint64_t mine = offer(distance_(voxel, from.cluster), from.cluster);
      while (mine < now) {
        if (!state.compare_exchange_weak(now, mine, std::memory_order_relaxed)) continue;
        // A voxel that changes hands twice in a level is still one of the next frontier.
        if (std::atomic_ref<std::uint8_t>(touched_[voxel]).exchange(1, std::memory_order_relaxed) == 0)
          won.push_back(voxel);
        break;
      }
    }
  }

  const VoxelTile& tile_;
  const Distance& distance_;
  std::vector<std::uint64_t> state_;
  std::vector<std::uint8_t> touched_;
  std::vector<TileSeed> frontier_;
};

template <class Distance>
std::vector<std::uint32_t> grow(const VoxelTile& tile, std::span<const TileSeed> seeds, const Distance& distance,
                                int levels) {
  Growth<Distance> growth(tile, distance);
  growth.seed(seeds);
  for (int level = 0; level < levels && !growth.done(); ++level) growth.advance();
  return growth.clusters();
}

}  // namespace

std::vector<std::uint32_t> grow_clusters(const VoxelTile& tile, const VoxelFeatures& features, const Clusters& clusters,
                                         std::span<const TileSeed> seeds, const SupervoxelParameters& parameters,
                                         const SupervoxelScale& scale) {
  const ClusterDistanceData data{tile, features, clusters};
  return parameters.features == SupervoxelParameters::Features::kFpfh
             ? grow(tile, seeds, HistogramDistance(data, parameters, scale), scale.levels)
             : grow(tile, seeds, NormalDistance(data, parameters, scale), scale.levels);
}

std::vector<TileSeed> tile_seeds(const VoxelTile& tile, const Clusters& clusters,
                                 std::span<const std::uint32_t> by_rank) {
  std::vector<TileSeed> seeds;
  std::size_t voxel = 0;
  for (const std::uint32_t cluster : by_rank) {
    const std::uint32_t rank = clusters.seed_ranks[cluster];
    while (voxel < tile.size() && tile.ranks[voxel] < rank) ++voxel;
    if (voxel == tile.size()) break;
    if (tile.ranks[voxel] == rank) seeds.push_back({static_cast<std::uint32_t>(voxel), cluster});
  }
  return seeds;
}

}  // namespace arris
