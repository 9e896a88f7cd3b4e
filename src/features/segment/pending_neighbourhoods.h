#pragma once
/// @file Neighbourhoods of equal size one after the other, until there are enough to lay them side by side.

#include <array>
#include <cstdint>
#include <vector>

#include "features/neighbourhood/nearest_select.h"
#include "features/segment/neighbourhood_batch.h"

namespace arris {

/// Each is written in one piece: to spread its coordinates over the rows of a batch at once would touch a line of cache
/// for every one of them. 512 bytes per neighbour, rounded up to multiples of 16.
class PendingNeighbourhoods {
 public:
  explicit PendingNeighbourhoods(std::size_t neighbours);

  std::size_t lanes() const { return lanes_; }
  bool full() const { return lanes_ == kBatchLanes; }
  std::uint32_t slot(std::size_t lane) const { return slot_[lane]; }

  /// The nearest of those found, as many as the constructor was told.
  void add(std::uint32_t slot, const Neighbours& found);
  /// The same neighbourhood again.
  void add(const PendingNeighbourhoods& from, std::size_t lane);
  /// All of them, with their mean distances: the distances are summed up from the nearest to the farthest.
  void lay_out(NeighbourhoodBatch& batch) const;
  void clear() { lanes_ = 0; }

 private:
  enum Column : std::size_t { kX, kY, kZ, kSquare, kColumns };
  double* row(std::size_t column, std::size_t lane) {
    return rows_.data() + (column * kBatchLanes + lane) * padded_neighbours_;
  }
  const double* row(std::size_t column, std::size_t lane) const {
    return rows_.data() + (column * kBatchLanes + lane) * padded_neighbours_;
  }
  struct LayOut;

  std::size_t neighbours_;
  std::size_t padded_neighbours_;
  std::size_t lanes_ = 0;
  std::array<std::uint32_t, kBatchLanes> slot_{};
  std::vector<double> rows_;  ///< By column, then lane, then neighbour. Lanes not in use are finite.
};

}  // namespace arris
