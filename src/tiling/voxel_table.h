#pragma once
/// @file Sums points per voxel in a bounded hash table.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/prefetch.h"
#include "core/voxel.h"
#include "tiling/page_array.h"
#include "tiling/voxel_lane.h"
#include "tiling/voxel_order.h"
#include "tiling/voxel_sums.h"

namespace arris::tiling {

/// Lanes that are filled side by side, as many as loops have threads, up to VoxelLane::kMostLanes. Colours take memory
/// from the first one on; points without count as black. How sums are dealt out depends on the lanes, what the sums of
/// a voxel come to together does not. Not thread-safe.
///
/// Memory: `size_bytes`, sorting included: 52 bytes per sum, 64 with colours.
class VoxelTable {
 public:
  /// @param likely_sums  about so many, 0: not known.
  VoxelTable(const VoxelGrid& grid, std::size_t size_bytes, std::size_t likely_sums = 0);

  /// True: all points were added. False: the table is full; take its sums and call it again with the same points, of
  /// which it goes on with the rest.
  /// @param colours  as many as positions, or none.
  bool add(std::span<const LatticePoint> positions, std::span<const RawColour> colours);
  std::size_t lanes() const { return lanes_.size(); }
  /// Points on their way into the lanes.
  class Dealt {
   public:
    bool all_added() const;

   private:
    friend class VoxelTable;
    std::vector<LanePoints> own_;     ///< Of each lane; none where there is one lane only.
    std::vector<std::size_t> added_;  ///< Of those.
    std::size_t size_ = 0;
  };
  /// Deals points out to the lanes. May be called by several threads.
  void deal(std::span<const LatticePoint> positions, Dealt& dealt) const;
  /// Adds the points of one lane that are not added yet; false if the lane is full. Different lanes may be added to at
  /// the same time, colours only after start_colours(). @param positions, colours  that were dealt out.
  bool add_to_lane(std::size_t lane, std::span<const LatticePoint> positions, std::span<const RawColour> colours,
                   Dealt& dealt);
  /// Makes room for them if there is none yet.
  void start_colours();
  bool empty() const { return size() == 0; }
  bool has_colours() const { return has_colours_; }

  /// All sums in Z-order of voxels, those of one voxel one after another.
  class Sorted {
   public:
    std::size_t size() const { return size_; }
    const LatticePoint& key(std::size_t i) const { return table_.sums_[order_[i]].key; }
    VoxelRecord operator[](std::size_t i) const {
      constexpr std::size_t kAhead = 16;
      if (i + kAhead < size_) prefetch(&table_.sums_[order_[i + kAhead]]);
      VoxelRecord record{table_.sums_[order_[i]], {}};
      if (table_.has_colours_) record.colour = table_.colours_[order_[i]];
      return record;
    }

   private:
    friend class VoxelTable;
    explicit Sorted(const VoxelTable& table)
        : table_(table), size_(table.size()), order_(z_order_of(table.sums_.first(size_))) {}
    const VoxelTable& table_;
    std::size_t size_;
    PageArray<std::uint32_t> order_;
  };
  /// Nothing may be added until clear(); the table must outlive it.
  Sorted sorted();
  void clear();

 private:
  std::size_t size() const;
  void set_limits();
  void touch(std::size_t sums);
  std::size_t lane_sums(bool colours) const;
  std::size_t room() const;
  void close_up();

  VoxelGrid grid_;
  std::size_t size_bytes_;
  LaneBlocks blocks_;  // Of sums_ and colours_.
  bool has_colours_ = false;
  PageArray<VoxelSums> sums_;
  PageArray<ColourSums> colours_;  // Beside sums_, if has_colours_.
  std::vector<VoxelLane> lanes_;
  Dealt dealt_;  // Of points that were not all added.
};

}  // namespace arris::tiling
