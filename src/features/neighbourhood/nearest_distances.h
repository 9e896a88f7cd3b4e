#pragma once
/// @file The distances of the k nearest neighbours: what the local spacing needs, without who they are.

#include "features/neighbourhood/nearest_select.h"

namespace arris {

/// Squared distances of a point's neighbours in ascending order, as in Neighbours. The point itself is not among them.
struct NearestDistances {
  std::size_t count = 0;
  std::vector<double> d2;  ///< Steps² (rounded above 2^53); padded with zeros.
  std::uint64_t last_d2 = 0;

  void reserve(std::size_t k) { d2.resize(simd::padded(k) + simd::kPadding); }
};

/// select_nearest() for distances alone: nothing has to be done about ties.
template <class T>
void select_nearest(const PointTree& tree, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, NearestDistances& found);

}  // namespace arris
