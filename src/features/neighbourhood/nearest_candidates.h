#pragma once
/// @file The candidates that are near enough to a query to hold its nearest neighbours.

#include "features/neighbourhood/nearest_select.h"

namespace arris {

/// How many there are within which distance.
template <class T>
struct Collected {
  std::size_t count = 0;
  T limit_d2 = 0;
};

/// Fills scratch.d2 and scratch.candidate, in the order of the candidates, with those within a distance that grows from
/// query.guess_d2 until it holds more than query.k of them (the query itself is one) or is query.max_d2. Up to
/// simd::kPadding more entries are overwritten. O(candidates).
template <class T>
Collected<T> collect_nearest(const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                             NearestScratch<T>& scratch);
/// The same without scratch.candidate.
template <class T>
Collected<T> collect_nearest_distances(const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                                       NearestScratch<T>& scratch);

}  // namespace arris
