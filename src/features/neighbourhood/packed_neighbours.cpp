#include "features/neighbourhood/packed_neighbours.h"

#include <type_traits>

#include "features/neighbourhood/nearest_candidates.h"
#include "features/neighbourhood/nearest_rows.h"
#include "features/neighbourhood/nearest_sorted.h"

namespace arris {

template <class T>
void select_nearest(const PointTree& tree, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, PackedNeighbours& found) {
  const std::size_t n = collect_nearest(candidates, query, scratch).count;
  if constexpr (std::is_same_v<T, float>) {
    found.narrow = n <= kMostRanked;
    if (found.narrow) {
      found.count = rank_rows(tree, candidates, query, n, scratch, found.rows.data());
      found.last_d2 = found.count > 0 ? static_cast<std::uint64_t>(found.offset(found.count - 1).squared()) : 0;
      return;
    }
  }
  found.narrow = false;
  found.wide.reserve(found.most());
  select_sorted(tree, candidates, query, n, scratch, found.wide);
  found.count = found.wide.count;
  found.last_d2 = found.wide.last_d2;
}

template void select_nearest(const PointTree&, const CandidateSet<float>&, const NearestQuery<float>&,
                             NearestScratch<float>&, PackedNeighbours&);
template void select_nearest(const PointTree&, const CandidateSet<double>&, const NearestQuery<double>&,
                             NearestScratch<double>&, PackedNeighbours&);
template void select_nearest(const PointTree&, const CandidateSet<std::int64_t>&, const NearestQuery<std::int64_t>&,
                             NearestScratch<std::int64_t>&, PackedNeighbours&);

}  // namespace arris
