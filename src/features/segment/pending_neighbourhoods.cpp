#include "features/segment/pending_neighbourhoods.h"

#include <algorithm>
#include <utility>

#include "features/neighbourhood/nearest_rows.h"
#include "features/numerics/columns_of_four.h"
#include "features/numerics/transpose.h"

namespace arris {

PendingNeighbourhoods::PendingNeighbourhoods(std::size_t neighbours) : neighbours_(neighbours) {
  for (PackedNeighbours& found : found_) found.reserve(neighbours);
}

void PendingNeighbourhoods::add(std::uint32_t slot, PackedNeighbours& found) {
  PackedNeighbours& own = found_[lanes_];
  own.narrow = found.narrow;
  if (found.narrow) {
    std::swap(own.rows, found.rows);
  } else {
    std::swap(own.wide, found.wide);
    found.narrow = true;  // It may have no room for wide ones now.
  }
  slot_[lanes_++] = slot;
}

struct PendingNeighbourhoods::LayOutRows {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const PendingNeighbourhoods& from, NeighbourhoodBatch& to) {
    using F = typename simd::Wide<Bytes>::Float;
    using D = typename simd::Wide<Bytes>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(float);
    for (std::size_t lane = 0; lane < kBatchLanes; lane += kLanes) {
      const PackedCandidate* rows[kLanes];
      for (std::size_t k = 0; k < kLanes; ++k) rows[k] = from.found_[lane + k].rows.data();
      const auto place = [&rows](std::size_t i) {
        return [&rows, i ](std::size_t k) __attribute__((always_inline)) {
          return rows[k] + i;
        };
      };
      const simd::ColumnsOfFour<F> query(place(0));
      D sums[2]{};
      for (std::size_t i = 0; i < from.neighbours_; ++i) {
        const simd::ColumnsOfFour<F> at(place(i + 1));
        const F x = at.a - query.a, y = at.b - query.b, z = at.c - query.c;
        simd::store_doubles(to.x[i].data() + lane, x);
        simd::store_doubles(to.y[i].data() + lane, y);
        simd::store_doubles(to.z[i].data() + lane, z);
        alignas(Bytes) double squares[kLanes];
        simd::store_doubles(squares, F{x * x + y * y + z * z});
        sums[0] += simd::square_root(simd::load<D>(squares));
        sums[1] += simd::square_root(simd::load<D>(squares + kLanes / 2));
      }
      simd::store(to.mean_distance.data() + lane, sums[0] / static_cast<double>(from.neighbours_));
      simd::store(to.mean_distance.data() + lane + kLanes / 2, sums[1] / static_cast<double>(from.neighbours_));
    }
  }
};

struct PendingNeighbourhoods::LayOutColumns {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const PendingNeighbourhoods& from, NeighbourhoodBatch& to) {
    using V = typename simd::Wide<Bytes>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    for (std::size_t lane = 0; lane < kBatchLanes; lane += kLanes) {
      const PackedNeighbours* const found = from.found_.data() + lane;
      V sum{};
      for (std::size_t begin = 0; begin < from.neighbours_; begin += kLanes) {
        V x[kLanes], y[kLanes], z[kLanes], squares[kLanes];
        ARRIS_UNROLL
        for (std::size_t k = 0; k < kLanes; ++k) {
          x[k] = simd::load<V>(found[k].wide.dx.data() + begin);
          y[k] = simd::load<V>(found[k].wide.dy.data() + begin);
          z[k] = simd::load<V>(found[k].wide.dz.data() + begin);
          squares[k] = simd::load<V>(found[k].wide.d2.data() + begin);
        }
        simd::transpose<kLanes>(x);
        simd::transpose<kLanes>(y);
        simd::transpose<kLanes>(z);
        simd::transpose<kLanes>(squares);
        const std::size_t count = std::min(kLanes, from.neighbours_ - begin);
        for (std::size_t i = 0; i < count; ++i) {
          simd::store(to.x[begin + i].data() + lane, x[i]);
          simd::store(to.y[begin + i].data() + lane, y[i]);
          simd::store(to.z[begin + i].data() + lane, z[i]);
          sum += simd::square_root(squares[i]);
        }
      }
      simd::store(to.mean_distance.data() + lane, sum / static_cast<double>(from.neighbours_));
    }
  }
};

void PendingNeighbourhoods::lay_out(NeighbourhoodBatch& batch) {
  batch.neighbours = neighbours_;
  batch.lanes = lanes_;
  const auto is_narrow = [](const PackedNeighbours& found) { return found.narrow; };
  if (std::all_of(found_.begin(), found_.end(), is_narrow)) return simd::dispatch<LayOutRows>(*this, batch);
  for (PackedNeighbours& found : found_) {
    if (!found.narrow) continue;
    found.narrow = false;
    found.wide.reserve(neighbours_);
    found.wide.count = neighbours_;
    part_rows(found.rows.data(), found.wide);
  }
  simd::dispatch<LayOutColumns>(*this, batch);
}

}  // namespace arris
