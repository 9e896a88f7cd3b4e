#pragma once
/// @file Neighbourhoods one after the other, until there are enough to lay them side by side.

#include <array>
#include <cstdint>

#include "features/neighbourhood/packed_neighbours.h"
#include "features/segment/neighbourhood_batch.h"

namespace arris {

/// Each is kept as it was found, in one piece: to spread its coordinates over the rows of a batch at once would touch a
/// line of cache for every one of them. About 37 kB, of which it uses what it needs.
class PendingNeighbourhoods {
 public:
  explicit PendingNeighbourhoods(std::size_t neighbours);

  std::size_t lanes() const { return lanes_; }
  bool full() const { return lanes_ == kBatchLanes; }
  std::uint32_t slot(std::size_t lane) const { return slot_[lane]; }

  /// The nearest of those found, as many as the constructor was told. Leaves other memory for as many in `found`.
  void add(std::uint32_t slot, PackedNeighbours& found);
  /// A neighbourhood from elsewhere, which is not there any more then.
  void add(PendingNeighbourhoods& from, std::size_t lane) { add(from.slot_[lane], from.found_[lane]); }
  /// All of them, with their mean distances: the distances are summed up from the nearest to the farthest.
  void lay_out(NeighbourhoodBatch& batch);
  void clear() { lanes_ = 0; }

 private:
  struct LayOutRows;
  struct LayOutColumns;

  std::size_t neighbours_;
  std::size_t lanes_ = 0;
  std::array<std::uint32_t, kBatchLanes> slot_{};
  std::array<PackedNeighbours, kBatchLanes> found_;  ///< Lanes not in use are finite.
};

}  // namespace arris
