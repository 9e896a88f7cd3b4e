#include "features/neighbourhood/distance_row.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "features/neighbourhood/nearest_candidates.h"

namespace arris {
namespace {

/// The first n of as many as a row has.
struct Fill {
  template <int Bytes, class Key, class T>
  static ARRIS_ALWAYS_INLINE void run(const T* d2, Key n, DistanceRow::Keys<Key>& row) {
    constexpr std::size_t kLanes = Bytes / sizeof(Key);
    typedef Key Keys __attribute__((vector_size(Bytes)));
    typedef T Distances __attribute__((vector_size(kLanes * sizeof(T))));
    Keys place;
    for (std::size_t lane = 0; lane < kLanes; ++lane) place[lane] = static_cast<Key>(lane);
    const Keys beyond = Keys{} + std::numeric_limits<Key>::max();
    ARRIS_UNROLL
    for (std::size_t i = 0; i < row.size(); i += kLanes) {
      const Keys keys = __builtin_convertvector(simd::load<Distances>(d2 + i), Keys);
      simd::store(row.data() + i, place < n ? keys : beyond);
      place += static_cast<Key>(kLanes);
    }
  }
};

}  // namespace

template <class T>
void select_nearest(const PointTree& /*tree*/, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, DistanceRow& found) {
  const Collected<T> near = collect_nearest_distances(candidates, query, scratch);
  std::size_t n = near.count;
  const std::size_t wanted = std::min(n, query.k + 1);  // With the query itself.
  found.count = wanted - 1;
  // On a surface the number grows with the square of the distance.
  found.probable_last_d2 = static_cast<double>(near.limit_d2) * static_cast<double>(wanted) / static_cast<double>(n);
  if (n > DistanceRow::kLength) {
    const auto last = scratch.d2.begin() + static_cast<std::ptrdiff_t>(wanted - 1);
    std::nth_element(scratch.d2.begin(), last, scratch.d2.begin() + static_cast<std::ptrdiff_t>(n));
    n = wanted;
  }
  found.narrow = std::is_same_v<T, float>;
  const T* const d2 = scratch.d2.data();
  if constexpr (std::is_same_v<T, float>) {
    simd::dispatch<Fill>(d2, static_cast<std::int32_t>(n), found.narrow_d2);
  } else {
    simd::dispatch<Fill>(d2, static_cast<std::int64_t>(n), found.wide_d2);
  }
}

template void select_nearest(const PointTree&, const CandidateSet<float>&, const NearestQuery<float>&,
                             NearestScratch<float>&, DistanceRow&);
template void select_nearest(const PointTree&, const CandidateSet<double>&, const NearestQuery<double>&,
                             NearestScratch<double>&, DistanceRow&);
template void select_nearest(const PointTree&, const CandidateSet<std::int64_t>&, const NearestQuery<std::int64_t>&,
                             NearestScratch<std::int64_t>&, DistanceRow&);

}  // namespace arris
