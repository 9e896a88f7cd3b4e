#include "features/supervoxel/cluster_growth.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <mutex>

#include "core/parallel.h"
#include "core/prefetch.h"
#include "features/supervoxel/cluster_distance.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 1024;             // Of the frontier.
constexpr std::size_t kSweepGrain = 128 * 1024;  // Of all voxels.
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

/// A state as several threads see it, and as one does: what is locked waits for memory.
template <bool kAlone>
struct State {
  std::uint64_t& state;
  std::uint64_t now() const {
    if constexpr (kAlone) return state;
    return std::atomic_ref(state).load(std::memory_order_relaxed);
  }
  /// False, and `now` anew, if another thread was faster.
  bool change(std::uint64_t& now, std::uint64_t to) const {
    if constexpr (!kAlone) return std::atomic_ref(state).compare_exchange_weak(now, to, std::memory_order_relaxed);
    state = to;
    return true;
  }
};

template <class Distance>
class Growth {
 public:
  Growth(const VoxelTile& tile, const Distance& distance) : tile_(tile), distance_(distance) {
    state_.resize(tile.size());
    touched_.resize(tile.size());
    parallel_for_chunks(tile.size(), kSweepGrain, [&](std::size_t begin, std::size_t end) {
      std::fill(state_.begin() + begin, state_.begin() + end, kFree);
      std::fill(touched_.begin() + begin, touched_.begin() + end, std::uint8_t{0});
    });
  }

  void seed(std::span<const TileSeed> seeds) {
    for (const TileSeed& s : seeds) {
      state_[s.voxel] = seed_state(s.cluster);
      frontier_.push_back(s);
    }
  }

  /// One level: offers of the frontier, which then is what they won.
  void advance() {
    won_.clear();
    if (loop_threads() == 1 || frontier_.size() <= kGrain) {
      for (std::size_t i = 0; i < frontier_.size(); ++i) make_offers<true>(i, won_);
    } else {
      std::mutex mutex;
      parallel_for_chunks(frontier_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        PageVector<std::uint32_t> mine;
        for (std::size_t i = begin; i < end; ++i) make_offers<false>(i, mine);
        const std::lock_guard lock(mutex);
        won_.insert(won_.end(), mine.begin(), mine.end());
      });
    }
    frontier_.resize(won_.size());
    parallel_for_chunks(won_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        frontier_[i] = {won_[i], cluster_of(state_[won_[i]])};
        touched_[won_[i]] = 0;
      }
    });
  }

  bool done() const { return frontier_.empty(); }

  PageVector<std::uint32_t> clusters() const {
    PageVector<std::uint32_t> result(state_.size());
    parallel_for_chunks(result.size(), kSweepGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) result[v] = cluster_of(state_[v]);
    });
    return result;
  }

 private:
  /// The frontier jumps about in memory: what the offers of the next ones touch is fetched meanwhile.
  void look_ahead(std::size_t i) const {
    const std::size_t end = frontier_.size();
    if (i + 3 * kAhead < end) prefetch(&tile_.neighbour_begin[frontier_[i + 3 * kAhead].voxel]);
    if (i + 2 * kAhead < end) prefetch(tile_.neighbours_of(frontier_[i + 2 * kAhead].voxel).data());
    if (i + kAhead >= end) return;
    for (const std::uint32_t voxel : tile_.neighbours_of(frontier_[i + kAhead].voxel)) {
      prefetch_to_write(&state_[voxel]);
      distance_.prefetch(voxel);
    }
  }

  template <bool kAlone>
  void make_offers(std::size_t i, PageVector<std::uint32_t>& won) {
    look_ahead(i);
    const TileSeed from = frontier_[i];
    for (const std::uint32_t voxel : tile_.neighbours_of(from.voxel)) {
      const State<kAlone> state{state_[voxel]};
      std::uint64_t now = state.now();
      if (now != kFree && cluster_of(now) == from.cluster) continue;
      const std::uint64_t mine = offer(distance_(voxel, from.cluster), from.cluster);
      while (mine < now) {
        if (!state.change(now, mine)) continue;
        if (first_touch(voxel)) won.push_back(voxel);
        break;
      }
    }
  }

  /// A voxel that changes hands twice in a level is still one of the next frontier. Should two threads both be first it
  /// is there twice, which changes nothing: an offer that is made again wins nothing.
  bool first_touch(std::uint32_t voxel) {
    const std::atomic_ref<std::uint8_t> touched(touched_[voxel]);
    if (touched.load(std::memory_order_relaxed) != 0) return false;
    touched.store(1, std::memory_order_relaxed);
    return true;
  }

  static constexpr std::size_t kAhead = 8;

  const VoxelTile& tile_;
  const Distance& distance_;
  PageVector<std::uint64_t> state_;
  PageVector<std::uint8_t> touched_;
  PageVector<TileSeed> frontier_;
  PageVector<std::uint32_t> won_;  // At this level.
};

template <class Distance>
PageVector<std::uint32_t> grow(const VoxelTile& tile, std::span<const TileSeed> seeds, const Distance& distance,
                               int levels) {
  Growth<Distance> growth(tile, distance);
  growth.seed(seeds);
  for (int level = 0; level < levels && !growth.done(); ++level) growth.advance();
  return growth.clusters();
}

}  // namespace

PageVector<std::uint32_t> grow_clusters(const VoxelTile& tile, const VoxelFeatures& features, const Clusters& clusters,
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
