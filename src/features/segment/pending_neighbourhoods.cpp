#include "features/segment/pending_neighbourhoods.h"

#include <algorithm>

#include "features/numerics/simd.h"
#include "features/numerics/transpose.h"

namespace arris {

PendingNeighbourhoods::PendingNeighbourhoods(std::size_t neighbours)
    : neighbours_(neighbours),
      padded_neighbours_(simd::padded(neighbours)),
      rows_(kColumns * kBatchLanes * padded_neighbours_, 1.0) {}

void PendingNeighbourhoods::add(std::uint32_t slot, const Neighbours& found) {
  std::copy_n(found.dx.data(), neighbours_, row(kX, lanes_));
  std::copy_n(found.dy.data(), neighbours_, row(kY, lanes_));
  std::copy_n(found.dz.data(), neighbours_, row(kZ, lanes_));
  std::copy_n(found.d2.data(), neighbours_, row(kSquare, lanes_));
  slot_[lanes_++] = slot;
}

void PendingNeighbourhoods::add(const PendingNeighbourhoods& from, std::size_t lane) {
  for (std::size_t column = 0; column < kColumns; ++column)
    std::copy_n(from.row(column, lane), neighbours_, row(column, lanes_));
  slot_[lanes_++] = from.slot_[lane];
}

struct PendingNeighbourhoods::LayOut {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const PendingNeighbourhoods& from, NeighbourhoodBatch& to) {
    using V = typename simd::Wide<Bytes>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    for (std::size_t lane = 0; lane < kBatchLanes; lane += kLanes) {
      V sum{};
      for (std::size_t begin = 0; begin < from.neighbours_; begin += kLanes) {
        // What is beyond the last neighbour lies within the rows of the batch, and nobody looks at it.
        simd::transpose<V>(from.row(kX, lane) + begin, from.padded_neighbours_, to.x[begin].data() + lane, kBatchLanes);
        simd::transpose<V>(from.row(kY, lane) + begin, from.padded_neighbours_, to.y[begin].data() + lane, kBatchLanes);
        simd::transpose<V>(from.row(kZ, lane) + begin, from.padded_neighbours_, to.z[begin].data() + lane, kBatchLanes);
        alignas(Bytes) double squares[kLanes][kLanes];
        simd::transpose<V>(from.row(kSquare, lane) + begin, from.padded_neighbours_, squares[0], kLanes);
        const std::size_t count = std::min(kLanes, from.neighbours_ - begin);
        for (std::size_t i = 0; i < count; ++i) sum += simd::square_root(simd::load<V>(squares[i]));
      }
      simd::store(to.mean_distance.data() + lane, sum / static_cast<double>(from.neighbours_));
    }
  }
};

void PendingNeighbourhoods::lay_out(NeighbourhoodBatch& batch) const {
  batch.neighbours = neighbours_;
  batch.lanes = lanes_;
  simd::dispatch<LayOut>(*this, batch);
}

}  // namespace arris
