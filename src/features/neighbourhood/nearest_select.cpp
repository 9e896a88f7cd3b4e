#include "features/neighbourhood/nearest_select.h"

#include <type_traits>

#include "features/neighbourhood/distance_ranks.h"
#include "features/neighbourhood/nearest_candidates.h"
#include "features/neighbourhood/nearest_rows.h"
#include "features/neighbourhood/nearest_sorted.h"

namespace arris {

template <class T>
void select_nearest(const PointTree& tree, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, Neighbours& found) {
  const std::size_t n = collect_nearest(candidates, query, scratch).count;
  if constexpr (std::is_same_v<T, float>) {
    if (n <= kMostRanked) {
      found.count = rank_rows(tree, candidates, query, n, scratch, scratch.rows.data());
      part_rows(scratch.rows.data(), found);
      return;
    }
  }
  select_sorted(tree, candidates, query, n, scratch, found);
}

template void select_nearest(const PointTree&, const CandidateSet<float>&, const NearestQuery<float>&,
                             NearestScratch<float>&, Neighbours&);
template void select_nearest(const PointTree&, const CandidateSet<double>&, const NearestQuery<double>&,
                             NearestScratch<double>&, Neighbours&);
template void select_nearest(const PointTree&, const CandidateSet<std::int64_t>&, const NearestQuery<std::int64_t>&,
                             NearestScratch<std::int64_t>&, Neighbours&);

}  // namespace arris
