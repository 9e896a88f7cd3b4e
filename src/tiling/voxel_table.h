#pragma once
/// @file Sums points per voxel in a bounded hash table.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/voxel.h"
#include "tiling/voxel_order.h"
#include "tiling/voxel_sums.h"

namespace arris::tiling {

/// Sums lie side by side in the order of their first points; slots with open addressing lead to them. A sum that is
/// full (most_points_summed) is left and another one begun for the same voxel, so 32 bits suffice. Colours take memory
/// from the first one on; points without count as black. Not thread-safe.
///
/// Memory: `size_bytes`, sorting included: 52 bytes per sum, 64 with colours.
class VoxelTable {
 public:
  VoxelTable(const VoxelGrid& grid, std::size_t size_bytes);

  /// Adds points from the first on; returns how many. Fewer than all only if the table is full.
  /// @param colours  as many as positions, or none.
  std::size_t add(std::span<const LatticePoint> positions, std::span<const RawColour> colours);
  bool empty() const { return sums_.empty(); }
  bool has_colours() const { return has_colours_; }

  /// Calls visit(const VoxelRecord&) for all sums in Z-order of voxels, those of one voxel one after another, and
  /// empties the table.
  template <class Visit>
  void drain(Visit&& visit) {
    free_slots();
    const std::vector<std::uint32_t> order = z_order_of(sums_);
    constexpr std::size_t kAhead = 16;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i + kAhead < order.size()) __builtin_prefetch(&sums_[order[i + kAhead]]);
      VoxelRecord record{sums_[order[i]], {}};
      if (has_colours_) record.colour = colours_[order[i]];
      visit(record);
    }
    sums_.clear();
    colours_.clear();
  }

 private:
  struct Batch;
  template <bool kColours>
  std::size_t add_batch(const Batch& batch, std::size_t count, const RawColour* colours);
  template <bool kColours>
  std::uint32_t find_or_begin(const LatticePoint& key, std::uint32_t hash);
  std::uint32_t begin_sum(const LatticePoint& key);
  void start_colours();
  void set_capacity();
  void rehash(std::size_t slots);
  void free_slots();

  VoxelGrid grid_;
  std::size_t size_bytes_;
  std::size_t capacity_ = 0;
  std::uint32_t most_points_ = 0;
  bool has_colours_ = false;
  std::vector<VoxelSums> sums_;
  std::vector<ColourSums> colours_;   // As many as sums_ if has_colours_.
  std::vector<std::uint32_t> slots_;  // Index into sums_ + 1, 0: free.
  std::size_t slots_full_at_ = 0;     // Sums at which slots_ must grow.
};

}  // namespace arris::tiling
