#pragma once
/// @file Sums points per voxel in a bounded hash table.

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/voxel.h"
#include "tiling/hash_slots.h"
#include "tiling/page_array.h"
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
  /// @param likely_sums  about so many, 0: not known.
  VoxelTable(const VoxelGrid& grid, std::size_t size_bytes, std::size_t likely_sums = 0);

  /// Adds points from the first on; returns how many. Fewer than all only if the table is full.
  /// @param colours  as many as positions, or none.
  std::size_t add(std::span<const LatticePoint> positions, std::span<const RawColour> colours);
  bool empty() const { return size_ == 0; }
  bool has_colours() const { return has_colours_; }

  /// Calls visit(const VoxelRecord&) for all sums in Z-order of voxels, those of one voxel one after another, and
  /// empties the table.
  template <class Visit>
  void drain(Visit&& visit) {
    free_slots();
    const PageArray<std::uint32_t> order = z_order_of(sums_.first(size_));
    constexpr std::size_t kAhead = 16;
    for (std::size_t i = 0; i < size_; ++i) {
      if (i + kAhead < size_) __builtin_prefetch(&sums_[order[i + kAhead]]);
      VoxelRecord record{sums_[order[i]], {}};
      if (has_colours_) record.colour = colours_[order[i]];
      visit(record);
    }
    size_ = 0;
  }

 private:
  struct Batch;
  template <bool kColours>
  std::size_t add_batch(const Batch& batch, std::size_t count, const RawColour* colours);
  std::size_t find(const LatticePoint& key, std::uint32_t hash) const;
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
  std::size_t size_ = 0;
  PageArray<VoxelSums> sums_;
  PageArray<ColourSums> colours_;  // Beside sums_, if has_colours_.
  HashSlots slots_;                // To sums_.
  std::size_t first_slots_ = 0;    // As many as the table had last.
  std::size_t slots_full_at_ = 0;  // Sums at which slots_ must grow.
  std::size_t growth_ = 0;         // So many times.
};

}  // namespace arris::tiling
