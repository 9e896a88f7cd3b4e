#include "features/supervoxel/cluster_growth.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "core/parallel.h"
#include "core/prefetch.h"
#include "features/supervoxel/cluster_distance.h"

namespace arris {
namespace {

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

/// Parts that threads share: a few for each, as fronts are longer in some than in others, of not too few voxels.
std::size_t part_count(std::size_t voxels) {
  constexpr std::size_t kPartsPerThread = 8, kLeastVoxels = 4096;
  const auto threads = static_cast<std::size_t>(loop_threads());
  return threads == 1 ? 1 : std::clamp<std::size_t>(voxels / kLeastVoxels, 1, kPartsPerThread * threads);
}

/// Voxels come in Z-order, so parts of them one after the other are compact. Each part is changed by one thread at a
/// time: what its voxels offer to those of other parts is put down, and taken when all have offered. Which offer wins
/// does not depend on the order of offers.
template <class Distance>
class Growth {
 public:
  Growth(const VoxelTile& tile, const Distance& distance)
      : tile_(tile), distance_(distance), parts_(part_count(tile.size())) {
    part_voxels_ = static_cast<std::uint32_t>((tile.size() + parts_.size() - 1) / parts_.size());
    for (Part& part : parts_) {
      for (std::vector<PageVector<Offer>>& sent : part.sent) sent.resize(parts_.size());
    }
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
      parts_[part_of(s.voxel)].won.push_back(s.voxel);
    }
  }

  /// One level: what was won at the one before is the frontier and makes offers. False: it is empty. A part goes on
  /// while others still take what was offered before: what it sends now lies elsewhere.
  bool advance() {
    sent_last_ ^= 1;
    parallel_for_chunks(parts_.size(), 1, [&](std::size_t part, std::size_t) {
      take_offers(part);
      make_offers(part);
    });
    return std::ranges::any_of(parts_, [](const Part& part) { return !part.frontier.empty(); });
  }

  /// Offers of the last level are taken.
  void finish() {
    sent_last_ ^= 1;
    parallel_for_chunks(parts_.size(), 1, [&](std::size_t part, std::size_t) { take_offers(part); });
  }

  PageVector<std::uint32_t> clusters() const {
    PageVector<std::uint32_t> result(state_.size());
    parallel_for_chunks(result.size(), kSweepGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) result[v] = cluster_of(state_[v]);
    });
    return result;
  }

 private:
  struct Offer {
    std::uint64_t state;
    std::uint32_t voxel;
  };
  struct alignas(64) Part {
    PageVector<TileSeed> frontier;
    PageVector<std::uint32_t> won;                       ///< Since the frontier was made.
    std::array<std::vector<PageVector<Offer>>, 2> sent;  ///< To every part, at this level and the one before.
  };

  std::size_t part_of(std::uint32_t voxel) const { return parts_.size() == 1 ? 0 : voxel / part_voxels_; }

  /// The frontier jumps about in memory: what the offers of the next ones touch is fetched meanwhile.
  void look_ahead(const PageVector<TileSeed>& frontier, std::size_t i) const {
    const std::size_t end = frontier.size();
    if (i + 3 * kAhead < end) prefetch(&tile_.neighbour_begin[frontier[i + 3 * kAhead].voxel]);
    if (i + 2 * kAhead < end) prefetch(tile_.neighbours_of(frontier[i + 2 * kAhead].voxel).data());
    if (i + kAhead >= end) return;
    for (const std::uint32_t voxel : tile_.neighbours_of(frontier[i + kAhead].voxel)) {
      prefetch_to_write(&state_[voxel]);
      distance_.prefetch(voxel);
    }
  }

  void make_offers(std::size_t own) {
    Part& part = parts_[own];
    std::vector<PageVector<Offer>>& sent = part.sent[sent_last_ ^ 1];
    const std::uint32_t begin = static_cast<std::uint32_t>(own) * part_voxels_;
    for (std::size_t i = 0; i < part.frontier.size(); ++i) {
      look_ahead(part.frontier, i);
      const TileSeed from = part.frontier[i];
      for (const std::uint32_t voxel : tile_.neighbours_of(from.voxel)) {
        const bool is_own = voxel - begin < part_voxels_;
        if (is_own && state_[voxel] != kFree && cluster_of(state_[voxel]) == from.cluster) continue;
        const std::uint64_t mine = offer(distance_(voxel, from.cluster), from.cluster);
        if (is_own) {
          take(part, {mine, voxel});
        } else {
          sent[part_of(voxel)].push_back({mine, voxel});
        }
      }
    }
  }

  void take_offers(std::size_t own) {
    Part& part = parts_[own];
    for (Part& from : parts_) {
      PageVector<Offer>& sent = from.sent[sent_last_][own];
      for (const Offer& made : sent) take(part, made);
      sent.clear();
    }
    part.frontier.clear();
    for (const std::uint32_t voxel : part.won) {
      part.frontier.push_back({voxel, cluster_of(state_[voxel])});
      touched_[voxel] = 0;
    }
    part.won.clear();
  }

  /// A voxel that changes hands twice in a level is still one of the next frontier.
  void take(Part& part, const Offer& made) {
    if (made.state >= state_[made.voxel]) return;
    state_[made.voxel] = made.state;
    if (touched_[made.voxel] != 0) return;
    touched_[made.voxel] = 1;
    part.won.push_back(made.voxel);
  }

  static constexpr std::size_t kAhead = 8;

  const VoxelTile& tile_;
  const Distance& distance_;
  std::vector<Part> parts_;
  std::uint32_t part_voxels_ = 0;
  std::size_t sent_last_ = 0;  // Of Part::sent: what is taken now.
  PageVector<std::uint64_t> state_;
  PageVector<std::uint8_t> touched_;
};

template <class Distance>
PageVector<std::uint32_t> grow(const VoxelTile& tile, std::span<const TileSeed> seeds, const Distance& distance,
                               int levels) {
  Growth<Distance> growth(tile, distance);
  growth.seed(seeds);
  for (int level = 0; level < levels && growth.advance(); ++level) {
  }
  growth.finish();
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
  const std::uint32_t* const ranks = tile.ranks.data();
  std::size_t voxel = 0;
  std::uint32_t here = tile.size() == 0 ? 0 : ranks[0];  // ranks[voxel], without having to wait for it.
  for (const std::uint32_t cluster : by_rank) {
    const std::uint32_t rank = clusters.seed_ranks[cluster];
    if (here < rank && voxel < tile.size()) {
      // Ranks ascend: the one sought is no more voxels away than the ranks differ, and as many where none is missing in
      // between, as in the only tile of a scan.
      const std::size_t end = std::min<std::size_t>(tile.size(), voxel + (rank - here) + 1);
      if (ranks[end - 1] == rank) {
        voxel = end - 1;
        here = rank;
      } else {
        voxel = static_cast<std::size_t>(std::lower_bound(ranks + voxel, ranks + end, rank) - ranks);
        if (voxel < tile.size()) here = ranks[voxel];
      }
    }
    if (voxel == tile.size()) break;
    if (here == rank) seeds.push_back({static_cast<std::uint32_t>(voxel), cluster});
  }
  return seeds;
}

}  // namespace arris
