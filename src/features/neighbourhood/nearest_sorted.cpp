#include "features/neighbourhood/nearest_sorted.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "features/neighbourhood/distance_ranks.h"

namespace arris {
namespace {

/// Whether some are equally far.
template <class T>
bool sort_by_rank(NearestScratch<T>& s, std::size_t n) {
  const bool ties = rank_distances(s.d2.data(), n, s.rank.data());
  for (std::size_t i = 0; i < n; ++i) {
    const auto place = static_cast<std::size_t>(s.rank[i]);
    s.sorted[place] = s.candidate[i];
    s.sorted_d2[place] = s.d2[i];
  }
  return ties;
}

template <class T>
void sort_by_comparison(NearestScratch<T>& s, std::size_t n, std::size_t wanted) {
  auto& pairs = s.pairs;
  pairs.resize(n);
  for (std::size_t i = 0; i < n; ++i) pairs[i] = {s.d2[i], s.candidate[i]};
  if (wanted < n) {
    // Everything that ties with the last one wanted must stay in.
    std::nth_element(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(wanted - 1), pairs.end());
    const T last = pairs[wanted - 1].first;
    const auto cut = std::partition(pairs.begin() + static_cast<std::ptrdiff_t>(wanted), pairs.end(),
                                    [last](const auto& pair) { return pair.first == last; });
    pairs.erase(cut, pairs.end());
  }
  std::sort(pairs.begin(), pairs.end());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    s.sorted_d2[i] = pairs[i].first;
    s.sorted[i] = pairs[i].second;
  }
  for (std::size_t i = pairs.size(); i < n; ++i) s.sorted_d2[i] = std::numeric_limits<T>::max();
}

/// Puts runs of equal distances that begin before `wanted` into the order of ids.
template <class T>
void order_ties(const PointTree& tree, const CandidateSet<T>& candidates, NearestScratch<T>& s, std::size_t n,
                std::size_t wanted) {
  for (std::size_t begin = 0; begin < wanted;) {
    std::size_t end = begin + 1;
    while (end < n && s.sorted_d2[end] == s.sorted_d2[begin]) ++end;
    if (end - begin > 1) {
      std::sort(
          s.sorted.begin() + static_cast<std::ptrdiff_t>(begin), s.sorted.begin() + static_cast<std::ptrdiff_t>(end),
          [&](std::uint32_t a, std::uint32_t b) { return tree.id(candidates.slot[a]) < tree.id(candidates.slot[b]); });
    }
    begin = end;
  }
}

}  // namespace

template <class T>
void select_sorted(const PointTree& tree, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                   std::size_t n, NearestScratch<T>& scratch, Neighbours& found) {
  const std::size_t wanted = std::min(n, query.k + 1);  // With the query itself, which comes first.
  bool ties = true;                                     // For all that is known.
  if constexpr (std::is_same_v<T, std::int64_t>) {
    sort_by_comparison(scratch, n, wanted);
  } else if (n <= kMostRanked) {
    ties = sort_by_rank(scratch, n);
  } else {
    sort_by_comparison(scratch, n, wanted);
  }
  if (ties) order_ties(tree, candidates, scratch, n, wanted);
  found.count = wanted - 1;
  for (std::size_t i = 0; i < found.count; ++i) {
    const std::uint32_t c = scratch.sorted[i + 1];
    found.dx[i] = static_cast<double>(candidates.x[c] - query.x);
    found.dy[i] = static_cast<double>(candidates.y[c] - query.y);
    found.dz[i] = static_cast<double>(candidates.z[c] - query.z);
    found.d2[i] = static_cast<double>(scratch.sorted_d2[i + 1]);
    found.slot[i] = candidates.slot[c];
  }
  for (std::size_t i = found.count; i < simd::padded(found.count); ++i) {
    found.dx[i] = found.dy[i] = found.dz[i] = found.d2[i] = 0.0;
  }
  found.last_d2 = found.count > 0 ? static_cast<std::uint64_t>(scratch.sorted_d2[found.count]) : 0;
}

template void select_sorted(const PointTree&, const CandidateSet<float>&, const NearestQuery<float>&, std::size_t,
                            NearestScratch<float>&, Neighbours&);
template void select_sorted(const PointTree&, const CandidateSet<double>&, const NearestQuery<double>&, std::size_t,
                            NearestScratch<double>&, Neighbours&);
template void select_sorted(const PointTree&, const CandidateSet<std::int64_t>&, const NearestQuery<std::int64_t>&,
                            std::size_t, NearestScratch<std::int64_t>&, Neighbours&);

}  // namespace arris
