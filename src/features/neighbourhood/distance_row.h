#pragma once
/// @file The distances of the nearest neighbours of a point in no order: what a SpacingBatch wants to know of it.

#include <array>
#include <cstdint>

#include "features/neighbourhood/nearest_select.h"

namespace arris {

/// Squared distances, the point's own 0 among them, and as many more of the nearest as were found on the way; the rest
/// of the row is filled with what is greater than any.
struct DistanceRow {
  static constexpr bool kOfPacked = false;  ///< Distances need no slots.
  static constexpr std::size_t kLength = 32;
  static constexpr std::size_t kMostNeighbours = kLength - 1;

  template <class Key>
  using Keys = std::array<Key, kLength>;

  /// Of the neighbours wanted and found.
  std::size_t count = 0;
  bool narrow = true;                        ///< Which of the two rows is filled.
  alignas(64) Keys<std::int32_t> narrow_d2;  ///< Steps², below 2^24.
  alignas(64) Keys<std::int64_t> wide_d2;    ///< Steps².
  double probable_last_d2 = 0.0;             ///< About that of the last neighbour: where others may begin to look.

  /// @param k  at most kMostNeighbours.
  void reserve(std::size_t /*k*/) {}
  double last_d2_guess() const { return probable_last_d2; }
};

/// select_nearest() for distances alone, unsorted: nothing has to be done about ties. O(candidates).
template <class T>
void select_nearest(const PointTree& tree, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, DistanceRow& found);

}  // namespace arris
