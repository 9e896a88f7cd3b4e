#include "features/segment/tile_neighbourhoods.h"

#include <cmath>

#include "core/parallel.h"
#include "features/neighbourhood/neighbour_search.h"
#include "features/segment/shape_batches.h"

namespace arris {
namespace {

constexpr std::size_t kChunkBuckets = 64;
constexpr std::size_t kLeastNeighbours = 3;

}  // namespace

/// One per chunk of buckets; writes the rows of its own slots only.
class TileNeighbourhoods::Runner {
 public:
  explicit Runner(TileNeighbourhoods& all)
      : all_(all),
        search_(all.tree_, {all.stride_, all.reach_steps_,
                            static_cast<std::uint64_t>(all.reach_steps_ * all.reach_steps_), Arithmetic::kFloat}),
        batches_(all.weights_) {}

  void run(std::span<const std::uint32_t> slots) {
    search_.run(slots, [&](std::uint32_t slot, const Neighbours& found) { take(slot, found); });
  }
  void finish() {
    batches_.flush([&](auto&&... arguments) { put(arguments...); });
  }

 private:
  void take(std::uint32_t slot, const Neighbours& found) {
    all_.counts_[slot] = static_cast<std::uint8_t>(found.count);
    std::copy_n(found.slot.begin(), found.count, all_.slots_.get() + slot * all_.stride_);
    if (found.count < kLeastNeighbours) {
      all_.states_[slot] = ShapeState::kIsolated;
    } else {
      batches_.add(slot, found, [&](auto&&... arguments) { put(arguments...); });
    }
  }
  void put(std::uint32_t slot, const PointShape& shape, bool has_normal) {
    all_.shapes_[slot] = shape;
    all_.states_[slot] = has_normal ? ShapeState::kShaped : ShapeState::kIsolated;
  }

  TileNeighbourhoods& all_;
  NeighbourSearch search_;
  ShapeBatches batches_;
};

TileNeighbourhoods::TileNeighbourhoods(const PointTree& tree, const Lattice& lattice,
                                       const SegmentParameters& parameters)
    : tree_(tree),
      stride_(parameters.most_neighbours()),
      reach_steps_(parameters.reach() / lattice.step),
      weights_{parameters.inlier_distance / lattice.step, parameters.published},
      slots_(std::make_unique_for_overwrite<std::uint32_t[]>(tree.size() * stride_)),
      counts_(tree.size()),
      shapes_(tree.size()),
      states_(tree.size(), ShapeState::kUnasked) {}

void TileNeighbourhoods::compute(const std::vector<std::uint8_t>& wanted) {
  parallel_for_chunks(tree_.buckets(), kChunkBuckets, [&](std::size_t first, std::size_t last) {
    Runner runner(*this);
    std::vector<std::uint32_t> slots;
    for (std::size_t bucket = first; bucket < last; ++bucket) {
      slots.clear();
      for (std::size_t slot = tree_.bucket_begin(bucket); slot < tree_.bucket_begin(bucket + 1); ++slot) {
        if (wanted[slot] != 0 && states_[slot] == ShapeState::kUnasked)
          slots.push_back(static_cast<std::uint32_t>(slot));
      }
      runner.run(slots);
    }
    runner.finish();
  });
}

double TileNeighbourhoods::reach_of(std::uint32_t slot) const {
  if (!full(slot)) return reach_steps_;
  const std::uint32_t last = neighbours(slot).back();
  return std::sqrt(static_cast<double>(squared_distance(tree_.position(slot), tree_.position(last)))) * (1.0 + 1e-12);
}

}  // namespace arris
