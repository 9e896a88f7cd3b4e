#include "features/segment/tile_neighbourhoods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "core/parallel.h"
#include "features/neighbourhood/neighbour_search.h"
#include "features/neighbourhood/packed_neighbours.h"
#include "features/neighbourhood/runner_pool.h"
#include "features/segment/shape_batches.h"

namespace arris {
namespace {

constexpr std::size_t kChunkBuckets = 64;
constexpr std::size_t kLeastNeighbours = 3;
/// Rounding of a distance must not make a ball too small.
constexpr double kRoundedUp = 1.0 + 1e-12;

}  // namespace

/// One per thread; writes the rows of its own slots only.
class TileNeighbourhoods::Runner {
 public:
  explicit Runner(TileNeighbourhoods& all)
      : all_(all), rows_(all.rows_), expected_(all.rule_.least()), batches_(all.weights_) {}

  /// What one group wanted at most is looked for around the next: few queries then need a second search, and what is
  /// found beyond what the rule wants is cut off.
  void run(std::span<const std::uint32_t> slots) {
    const std::size_t first = std::exchange(expected_, all_.rule_.least());
    for (auto& more : more_) more.clear();
    search_for(first, slots);
    for (std::size_t k = first + 1; k <= all_.rule_.most(); ++k) search_for(k, more_[k]);
  }
  void finish() {
    batches_.flush([&](auto&&... arguments) { put(arguments...); });
  }

 private:
  using Search = NearestSearch<PackedNeighbours>;

  void search_for(std::size_t k, std::span<const std::uint32_t> slots) {
    if (slots.empty()) return;
    if (!searches_[k]) {
      searches_[k] = std::make_unique<Search>(all_.tree_, all_.limits(k));
    }
    searches_[k]->run(slots, [&](std::uint32_t slot, PackedNeighbours& found) {
      const std::size_t least = all_.rule_.least();
      const std::size_t wanted = found.count < least ? all_.rule_.most() : all_.rule_.wanted(found);
      expected_ = std::max(expected_, std::min(wanted, k));
      all_.wanted_[slot] = static_cast<std::uint8_t>(wanted);
      if (wanted > k && found.count == k) {
        more_[wanted].push_back(slot);
      } else {
        take(slot, found, std::min(found.count, wanted));
      }
    });
  }
  void take(std::uint32_t slot, PackedNeighbours& found, std::size_t count) {
    const std::uint64_t reach2 = squared_reach(found, count);
    all_.squared_reaches_[slot] = static_cast<std::uint32_t>(std::min<std::uint64_t>(reach2, kFar));
    if (found.narrow) {
      rows_.put(slot, count, [rows = found.rows.data() + 1](std::size_t i) { return rows[i].slot; });
    } else {
      rows_.put(slot, count, [&found](std::size_t i) { return found.wide.slot[i]; });
    }
    if (count < kLeastNeighbours) {
      all_.states_[slot] = ShapeState::kIsolated;
    } else {
      batches_.add(slot, found, count, [&](auto&&... arguments) { put(arguments...); });
    }
  }
  static std::uint64_t squared_reach(const PackedNeighbours& found, std::size_t count) {
    if (count == 0) return 0;
    return count == found.count ? found.last_d2 : static_cast<std::uint64_t>(found.offset(count - 1).squared());
  }
  void put(std::uint32_t slot, const PointShape& shape, bool has_normal) {
    all_.shapes_[slot] = shape;
    all_.states_[slot] = has_normal ? ShapeState::kShaped : ShapeState::kIsolated;
  }

  TileNeighbourhoods& all_;
  NeighbourRows::Writer rows_;
  /// By the number of neighbours that they look for.
  std::array<std::unique_ptr<Search>, kMostNeighbours + 1> searches_;
  std::array<std::vector<std::uint32_t>, kMostNeighbours + 1> more_;
  std::size_t expected_;
  ShapeBatches batches_;
};

TileNeighbourhoods::TileNeighbourhoods(const PointTree& tree, const Lattice& lattice,
                                       const SegmentParameters& parameters)
    : tree_(tree),
      rule_(neighbour_rule(parameters, lattice.step)),
      reach_steps_(parameters.reach() / lattice.step),
      weights_{parameters.inlier_distance / lattice.step, parameters.published},
      rows_(tree.size(), rule_.most()),
      wanted_(tree.size(), 0),
      shapes_(tree.size()),
      states_(tree.size(), ShapeState::kUnasked),
      squared_reaches_(tree.size()) {}

void TileNeighbourhoods::compute(std::span<const std::uint8_t> wanted) {
  const auto run_buckets = [&](Runner& runner, std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> slots;
    for (std::size_t bucket = first; bucket < last; ++bucket) {
      slots.clear();
      for (std::size_t slot = tree_.bucket_begin(bucket); slot < tree_.bucket_begin(bucket + 1); ++slot) {
        if (wanted[slot] != 0 && states_[slot] == ShapeState::kUnasked)
          slots.push_back(static_cast<std::uint32_t>(slot));
      }
      runner.run(slots);
    }
  };
  RunnerPool<Runner> pool;
  parallel_for_chunks(tree_.buckets(), kChunkBuckets, [&](std::size_t first, std::size_t last) {
    pool.with_one([this] { return Runner(*this); }, [&](Runner& runner) { run_buckets(runner, first, last); });
  });
  for (auto& runner : pool.idle()) runner->finish();
}

SearchLimits TileNeighbourhoods::limits(std::size_t k) const {
  return {k, reach_steps_, static_cast<std::uint64_t>(reach_steps_ * reach_steps_), Arithmetic::kFloat};
}

double TileNeighbourhoods::reach_of(std::uint32_t slot) const {
  if (!full(slot)) return reach_steps_;
  return std::sqrt(static_cast<double>(squared_reach(slot))) * kRoundedUp;
}

std::optional<double> TileNeighbourhoods::most_reach(std::size_t first, std::size_t last) const {
  std::uint64_t most2 = 0;
  bool any = false, all_full = true;
  for (std::size_t i = first; i < last; ++i) {
    const auto slot = static_cast<std::uint32_t>(i);
    if (states_[slot] == ShapeState::kUnasked) continue;
    any = true;
    all_full = all_full && full(slot);
    most2 = std::max(most2, squared_reach(slot));
  }
  if (!any) return std::nullopt;
  return all_full ? std::sqrt(static_cast<double>(most2)) * kRoundedUp : reach_steps_;
}

std::optional<double> TileNeighbourhoods::ball_of_most(std::uint32_t slot) const {
  std::optional<double> radius;
  NeighbourSearch search(tree_, limits(rule_.most()));
  search.run(std::span(&slot, 1), [&](std::uint32_t, const Neighbours& found) {
    if (found.count == rule_.most()) radius = std::sqrt(static_cast<double>(found.last_d2)) * kRoundedUp;
  });
  return radius;
}

}  // namespace arris
