#include "features/neighbourhood/nearest_distances.h"

#include <algorithm>
#include <type_traits>

#include "features/neighbourhood/nearest_candidates.h"

namespace arris {
namespace {

/// Above this many, a comparison sort beats counting.
constexpr std::size_t kMostRanked = 160;

/// Sorts by counting, for each value, how many are smaller. Of equal values one gets its place; its free neighbours are
/// filled from it.
struct SortByRank {
  template <int Bytes, class T>
  static ARRIS_ALWAYS_INLINE void run(const T* values, std::size_t n, std::int32_t* rank, T* sorted) {
    using V = typename simd::VectorOf<T, Bytes>::Type;
    using Mask = typename simd::VectorOf<T, Bytes>::Mask;
    constexpr std::size_t kLanes = simd::VectorOf<T, Bytes>::kLanes;
    constexpr T kFree = -1;
    for (std::size_t block = 0; block < n; block += kLanes) {
      const V mine = simd::load<V>(values + block);
      Mask smaller{};
      for (std::size_t j = 0; j < n; ++j) smaller -= (mine > values[j]);
      for (std::size_t lane = 0; lane < kLanes; ++lane) rank[block + lane] = static_cast<std::int32_t>(smaller[lane]);
      simd::store(sorted + block, V{} + kFree);
    }
    for (std::size_t i = 0; i < n; ++i) sorted[rank[i]] = values[i];
    for (std::size_t i = 1; i < n; ++i) sorted[i] = sorted[i] == kFree ? sorted[i - 1] : sorted[i];
  }
};

}  // namespace

template <class T>
void select_nearest(const PointTree& /*tree*/, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, NearestDistances& found) {
  const std::size_t n = collect_nearest_distances(candidates, query, scratch);
  const std::size_t wanted = std::min(n, query.k + 1);  // With the query itself, which comes first.
  const T* sorted = scratch.d2.data();
  if (std::is_same_v<T, std::int64_t> || n > kMostRanked) {
    std::partial_sort(scratch.d2.begin(), scratch.d2.begin() + static_cast<std::ptrdiff_t>(wanted),
                      scratch.d2.begin() + static_cast<std::ptrdiff_t>(n));
  } else if constexpr (!std::is_same_v<T, std::int64_t>) {
    simd::dispatch<SortByRank>(sorted, n, scratch.rank.data(), scratch.sorted_d2.data());
    sorted = scratch.sorted_d2.data();
  }
  found.count = wanted - 1;
  for (std::size_t i = 0; i < found.count; ++i) found.d2[i] = static_cast<double>(sorted[i + 1]);
  for (std::size_t i = found.count; i < simd::padded(found.count); ++i) found.d2[i] = 0.0;
  found.last_d2 = found.count > 0 ? static_cast<std::uint64_t>(sorted[found.count]) : 0;
}

template void select_nearest(const PointTree&, const CandidateSet<float>&, const NearestQuery<float>&,
                             NearestScratch<float>&, NearestDistances&);
template void select_nearest(const PointTree&, const CandidateSet<double>&, const NearestQuery<double>&,
                             NearestScratch<double>&, NearestDistances&);
template void select_nearest(const PointTree&, const CandidateSet<std::int64_t>&, const NearestQuery<std::int64_t>&,
                             NearestScratch<std::int64_t>&, NearestDistances&);

}  // namespace arris
