#include "features/segment/intensity_smoothing.h"

#include <array>
#include <memory>

#include "core/parallel.h"
#include "features/numerics/simd.h"
#include "features/segment/selection_network.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 8192;
/// As many as the widest vectors have bytes.
constexpr std::size_t kLanes = 64;
constexpr std::size_t kMostValues = kMostNeighbours + 1;

/// Of `count` values the upper median is wanted.
struct MedianNetwork {
  std::size_t count = 0;
  std::vector<std::array<std::uint8_t, 2>> exchanges;
  std::size_t median() const { return count / 2; }
};

const MedianNetwork& median_network(std::size_t count) {
  static const std::array<MedianNetwork, kMostValues + 1> networks = [] {
    std::array<MedianNetwork, kMostValues + 1> all;
    for (std::size_t n = 1; n < all.size(); ++n) all[n] = {n, selection_network(n, n / 2)};
    return all;
  }();
  return networks[count];
}

/// Points side by side, one per lane, all with the same number of values.
struct MedianBatch {
  explicit MedianBatch(std::size_t count) : network(median_network(count)) {}

  const MedianNetwork& network;
  std::size_t lanes = 0;
  std::array<std::uint32_t, kLanes> slot{};
  alignas(kLanes) std::array<std::array<std::uint8_t, kLanes>, kMostValues> values{};
};

/// The row network.median() gets the medians.
struct SelectMedians {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(MedianBatch& batch) {
    typedef std::uint8_t Values __attribute__((vector_size(Bytes)));
    for (std::size_t lane = 0; lane < kLanes; lane += Bytes) {
      for (const auto& [i, j] : batch.network.exchanges) {
        const auto a = simd::load<Values>(batch.values[i].data() + lane);
        const auto b = simd::load<Values>(batch.values[j].data() + lane);
        simd::store(batch.values[i].data() + lane, a < b ? a : b);
        simd::store(batch.values[j].data() + lane, a < b ? b : a);
      }
    }
  }
};

/// Collects points by their numbers of values. Not thread-safe.
class Smoother {
 public:
  Smoother(const TileNeighbourhoods& points, std::span<const std::uint8_t> from, std::span<std::uint8_t> to)
      : points_(points), from_(from), to_(to) {}

  void add(std::uint32_t slot) {
    const std::size_t values = points_.count(slot) + 1;
    auto& batch = batches_[values];
    if (!batch) batch = std::make_unique<MedianBatch>(values);
    const std::size_t lane = batch->lanes++;
    batch->slot[lane] = slot;
    batch->values[0][lane] = from_[slot];
    std::size_t i = 0;
    points_.visit_neighbours(slot, [&](std::uint32_t neighbour) {
      batch->values[++i][lane] = from_[neighbour];
      return true;
    });
    if (batch->lanes == kLanes) settle(*batch);
  }
  void finish() {
    for (const auto& batch : batches_)
      if (batch && batch->lanes > 0) settle(*batch);
  }

 private:
  void settle(MedianBatch& batch) {
    simd::dispatch<SelectMedians>(batch);
    const auto& medians = batch.values[batch.network.median()];
    for (std::size_t lane = 0; lane < batch.lanes; ++lane) to_[batch.slot[lane]] = medians[lane];
    batch.lanes = 0;
  }

  const TileNeighbourhoods& points_;
  std::span<const std::uint8_t> from_;
  std::span<std::uint8_t> to_;
  std::array<std::unique_ptr<MedianBatch>, kMostValues + 1> batches_;
};

}  // namespace

PageVector<std::uint8_t> smoothed_intensities(const TileNeighbourhoods& points,
                                              std::span<const std::uint8_t> intensities) {
  PageVector<std::uint8_t> smooth(intensities.begin(), intensities.end());
  parallel_for_chunks(smooth.size(), kGrain, [&](std::size_t first, std::size_t last) {
    Smoother smoother(points, intensities, smooth);
    for (std::size_t i = first; i < last; ++i) {
      const auto slot = static_cast<std::uint32_t>(i);
      if (points.state(slot) == ShapeState::kShaped) smoother.add(slot);
    }
    smoother.finish();
  });
  return smooth;
}

}  // namespace arris
