#pragma once
/// @file Sums points per voxel in one part of a table of voxels.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/voxel.h"
#include "tiling/hash_slots.h"
#include "tiling/voxel_sums.h"

namespace arris::tiling {

struct VoxelBatch;

/// How lanes share an array: a block for the first, one for the second and so on, again and again, so that there are
/// hardly any holes when they hold about as much as each other.
struct LaneBlocks {
  static constexpr std::size_t kSize = 4096;  ///< Of a block.
  std::size_t lanes = 1;

  /// Of the array, for the i-th element of a lane.
  std::size_t index(std::size_t lane, std::size_t i) const { return (i / kSize * lanes + lane) * kSize + i % kSize; }
};

/// Points of a lane, by their places among others.
using LanePoints = std::vector<std::uint32_t>;

/// Voxels are dealt out to lanes by their hashes, so that lanes run side by side and share nothing. Sums lie in the
/// order of their first points; slots with open addressing lead to them. A sum that is full (most_points_summed) is
/// left and another one begun for the same voxel, so 32 bits suffice. Not thread-safe.
class VoxelLane {
 public:
  /// Lanes are powers of two up to this.
  static constexpr std::uint32_t kMostLanes = 4;

  /// @param number  of blocks.lanes. @param sums  of all lanes. @param likely_sums  of this, about; 0: not known.
  VoxelLane(const VoxelGrid& grid, std::uint32_t number, const LaneBlocks& blocks, VoxelSums* sums,
            std::size_t likely_sums);

  /// @param sums  at most. @param points  in a sum, at most.
  void set_limits(std::size_t sums, std::uint32_t points);
  /// From here on there are colours. @param colours  of all lanes, beside the other sums.
  void start_colours(ColourSums* colours);

  /// Which of the points are whose. @param lanes  as many as there are.
  static void deal(const VoxelGrid& grid, std::span<const LatticePoint> positions, std::span<LanePoints> lanes);

  /// Adds its points; returns how many of them: fewer than all only if it is full.
  /// @param colours  as many as positions, or none. @param own  places of its points.
  std::size_t add(std::span<const LatticePoint> positions, std::span<const RawColour> colours,
                  std::span<const std::uint32_t> own);
  /// The same where all points are its own.
  std::size_t add_all(std::span<const LatticePoint> positions, std::span<const RawColour> colours);
  std::size_t size() const { return size_; }
  /// Makes those that it begins with, by all threads; the first add() does so too.
  void make_slots();
  void free_slots();
  /// To be called when the sums were taken.
  void clear() { size_ = 0; }

 private:
  template <bool kColours>
  std::size_t add_batch(const VoxelBatch& batch, std::size_t count);
  template <class Place>
  std::size_t add_each(std::span<const LatticePoint> positions, std::span<const RawColour> colours, std::size_t size,
                       const Place& place);
  std::size_t find(const LatticePoint& key, std::uint32_t hash) const;
  std::uint32_t find_or_begin(const LatticePoint& key, std::uint32_t hash);
  std::uint32_t begin_sum(const LatticePoint& key);
  void rehash(std::size_t slots);

  VoxelGrid grid_;
  std::uint32_t number_;
  LaneBlocks blocks_;
  VoxelSums* sums_;
  ColourSums* colours_ = nullptr;  // Beside sums_, if there are any.
  std::size_t capacity_ = 0, size_ = 0;
  std::uint32_t most_points_ = 0;
  HashSlots slots_;  // To sums_.
  std::size_t likely_sums_;
  std::size_t first_slots_ = 0;    // As many as there were last.
  std::size_t slots_full_at_ = 0;  // Sums at which slots_ must grow.
  std::size_t growth_;             // So many times.
};

}  // namespace arris::tiling
