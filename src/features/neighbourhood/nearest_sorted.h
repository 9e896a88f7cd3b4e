#pragma once
/// @file Nearest neighbours among however many candidates.

#include "features/neighbourhood/nearest_select.h"

namespace arris {

/// select_nearest() where the n candidates that were collected are in the scratch.
template <class T>
void select_sorted(const PointTree& tree, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                   std::size_t n, NearestScratch<T>& scratch, Neighbours& found);

}  // namespace arris
