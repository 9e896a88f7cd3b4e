#include "features/neighbourhood/spacing_batch.h"

#include "features/neighbourhood/density_weights.h"
#include "features/numerics/sorting_network.h"
#include "features/numerics/transpose.h"

namespace arris {

template <class Key>
struct SpacingBatch<Key>::Kernel {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(SpacingBatch& batch) {
    for (std::size_t i = 0; i < kCount; i += Bytes / sizeof(Key)) sort<Bytes>(batch, i);
    for (std::size_t i = 0; i < kCount; i += Bytes / sizeof(double)) add_up<Bytes>(batch, i);
  }

 private:
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void sort(SpacingBatch& batch, std::size_t first) {
    constexpr std::size_t kLanes = Bytes / sizeof(Key);
    typedef Key V __attribute__((vector_size(Bytes)));
    V values[DistanceRow::kLength];
    ARRIS_UNROLL
    for (std::size_t begin = 0; begin < DistanceRow::kLength; begin += kLanes) {
      ARRIS_UNROLL
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        values[begin + lane] = simd::load<V>(batch.rows_[first + lane].data() + begin);
      }
      simd::transpose<kLanes>(values + begin);
    }
    RankNetwork<DistanceRow::kLength, kFirst + 1, kNeighbours>::run(values);  // The point itself comes first.
    ARRIS_UNROLL
    for (std::size_t j = kFirst; j < kNeighbours; ++j) {
      simd::store(batch.sorted_[j - kFirst].data() + first, values[j + 1]);
    }
  }

  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void add_up(SpacingBatch& batch, std::size_t first) {
    using V = typename simd::Wide<Bytes>::Double;
    typedef Key K __attribute__((vector_size(Bytes / sizeof(double) * sizeof(Key))));
    V parts[kDensityParts]{};
    ARRIS_UNROLL
    for (std::size_t j = kFirst; j < kNeighbours; ++j) {
      const V d2 = __builtin_convertvector(simd::load<K>(batch.sorted_[j - kFirst].data() + first), V);
      parts[j % kDensityParts] += simd::square_root(d2) * kDensityWeights.at[j];
    }
    const V sum = (parts[0] + parts[1]) + (parts[2] + parts[3]);
    simd::store(batch.density_.data() + first, sum / static_cast<double>(kNeighbours - kFirst));
  }
};

template <class Key>
void SpacingBatch<Key>::solve() {
  simd::dispatch<Kernel>(*this);
  last_d2_ = sorted_.back();
}

template class SpacingBatch<std::int32_t>;
template class SpacingBatch<std::int64_t>;

}  // namespace arris
