#pragma once
/// @file Which voxels exist, in memory.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/lattice.h"
#include "tiling/growing_array.h"
#include "tiling/hash_slots.h"

namespace arris::tiling {

/// Consecutive blocks of an index.
struct BlockRange {
  std::size_t begin;
  std::size_t end;
  friend bool operator==(const BlockRange&, const BlockRange&) = default;
};

/// Which voxels exist, and the rank of each in Z-order (morton.h). Blocks of 8x8x8 voxels with a bit per voxel: 40
/// bytes per block and 8 per 4x4x4 part of it that is not empty; 1 to 3 bytes per voxel of a surface. Immutable once
/// filled; reading is thread-safe.
class VoxelIndex {
 public:
  static constexpr std::uint32_t kNone = HashSlots::kNone;
  static constexpr int kBlockSide = 8;             ///< Voxels.
  static constexpr std::uint32_t kBlockParts = 8;  ///< 64 voxels each.

  /// Keys in strictly ascending Z-order, fewer than 2^32 - 1.
  void append(const LatticePoint& key);
  /// Call after the last append().
  void finish();
  /// An index of the voxels of some blocks, ascending ranges, whose ranks begin at 0. Its bounds are those of the
  /// blocks.
  VoxelIndex selection(std::span<const BlockRange> ranges) const;

  std::uint32_t size() const { return size_; }
  /// Rank of the voxel, kNone if it does not exist. O(1); fast for neighbours of the voxel asked for last if `hint`
  /// (any value at first, kept by the caller, one per thread) is passed.
  std::uint32_t rank(const LatticePoint& key, std::uint32_t& hint) const {
    const LatticePoint block{key.x >> kLog2, key.y >> kLog2, key.z >> kLog2};
    if (hint >= blocks_.size() || !(blocks_[hint].key == block)) {
      const std::uint32_t found = find_block(block);
      if (found == kNone) return kNone;
      hint = found;
    }
    return rank_in(blocks_[hint], place_in_block(key));
  }
  std::uint32_t rank(const LatticePoint& key) const {
    std::uint32_t hint = 0;
    return rank(key, hint);
  }
  /// Ranks of many voxels (equal lengths): what the next ones are found by is fetched meanwhile, so that keys in any
  /// order take half the time.
  void ranks(std::span<const LatticePoint> keys, std::span<std::uint32_t> ranks) const;
  /// Ranks of the voxel and the 26 around it: ranks[9 (dx + 1) + 3 (dy + 1) + (dz + 1)], kNone where there is none,
  /// also beyond the ends of int32. Less than half the time of 26 calls of rank().
  void ranks_around(const LatticePoint& key, std::uint32_t& hint, std::array<std::uint32_t, 27>& ranks) const;
  /// Of the keys, half-open; empty if there are none.
  const LatticeBox& bounds() const { return bounds_; }
  std::uint64_t memory_bytes() const {
    return blocks_.memory_bytes() + words_.memory_bytes() + slots_.size() * sizeof(std::uint32_t);
  }

  struct Block {
    LatticePoint key;          ///< Voxel keys >> 3.
    std::uint32_t first_rank;  ///< Ranks of a block are consecutive.
    std::uint32_t voxels;
  };
  std::size_t blocks() const { return blocks_.size(); }
  Block block(std::size_t i) const;  ///< In Z-order.
  /// The first rank of a block; block may be blocks().
  std::uint32_t first_rank(std::size_t block) const {
    return block < blocks_.size() ? blocks_[block].first_rank : size_;
  }
  /// Calls use(key) for the voxels with ranks [begin, end), ascending.
  template <class Use>
  void for_each_key(std::uint32_t begin, std::uint32_t end, Use&& use) const {
    std::uint32_t rank = begin;
    for (std::size_t i = begin < end ? block_of_rank(begin) : 0; rank < end; ++i) {
      const Entry& entry = blocks_[i];
      for (std::uint32_t part = 0; part < kBlockParts && rank < end; ++part) {
        const Part voxels = part_of(entry, part);
        std::uint64_t bits = voxels.bits;
        for (std::uint32_t at = voxels.first_rank; at < rank && bits != 0; ++at) bits &= bits - 1;
        for (; bits != 0 && rank < end; bits &= bits - 1, ++rank)
          use(key_at(entry.key, 64 * part + static_cast<std::uint32_t>(std::countr_zero(bits))));
      }
    }
  }
  /// Index of the block with this key (voxel keys >> 3), kNone if it does not exist.
  std::uint32_t find_block(const LatticePoint& block_key) const;

  /// Place of a voxel in its block, in Z-order: 64 * part + bit.
  static constexpr std::uint32_t place_in_block(const LatticePoint& key) {
    return std::uint32_t{kSpread[key.x & 7]} << 2 | std::uint32_t{kSpread[key.y & 7]} << 1 | kSpread[key.z & 7];
  }
  /// The voxels of an eighth of a block.
  struct Part {
    std::uint64_t bits;
    std::uint32_t first_rank;
    std::uint32_t rank(std::uint32_t bit) const { return first_rank + ones(bits & ((std::uint64_t{1} << bit) - 1)); }
  };
  Part part(std::size_t block, std::uint32_t part) const { return part_of(blocks_[block], part); }

  // std::popcount is a call on processors without the instruction.
  static std::uint32_t ones(std::uint64_t v) {
    v -= v >> 1 & 0x5555555555555555U;
    v = (v & 0x3333333333333333U) + (v >> 2 & 0x3333333333333333U);
    v = (v + (v >> 4)) & 0x0f0f0f0f0f0f0f0fU;
    return static_cast<std::uint32_t>(v * 0x0101010101010101U >> 56);
  }

 private:
  static constexpr int kLog2 = 3;
  /// 32 bytes. The eight parts of a block, 4x4x4 voxels each, have a word of bits in words_, unless they are empty.
  /// The fields of part 0 would be zero: they are not stored, and (part - 1) & 7 leads to bits that are zero.
  struct Entry {
    LatticePoint key;
    std::uint32_t first_rank;
    std::uint64_t before;  // From bit 9 (part - 1) on: voxels in the parts before.
    std::uint32_t first_word;
    std::uint32_t parts;  // From bit 3 (part - 1) on: words before that of the part; bit 24 + part: it has one.
  };
  static_assert(sizeof(Entry) == 32);

  static constexpr std::array<std::uint8_t, 8> kSpread{0, 1, 8, 9, 64, 65, 72, 73};
  /// The key at a place of a block.
  static LatticePoint key_at(const LatticePoint& block, std::uint32_t place) {
    const auto along = [place](std::uint32_t at) {
      return static_cast<std::int32_t>((place >> at & 1) | (place >> (at + 3) & 1) << 1 | (place >> (at + 6) & 1) << 2);
    };
    return {block.x * kBlockSide + along(2), block.y * kBlockSide + along(1), block.z * kBlockSide + along(0)};
  }
  std::size_t block_of_rank(std::uint32_t rank) const;
  void ranks_of_some(std::span<const LatticePoint> keys, std::span<std::uint32_t> ranks) const;
  void add_slots();
  static std::size_t word_of(const Entry& entry, std::uint32_t part) {
    return entry.first_word + (entry.parts >> 3 * ((part - 1) & 7) & 7);
  }
  Part part_of(const Entry& entry, std::uint32_t part) const {
    if ((entry.parts >> (24 + part) & 1) == 0) return {0, 0};
    const auto before = static_cast<std::uint32_t>(entry.before >> 9 * ((part - 1) & 7) & 511);
    return {words_[word_of(entry, part)], entry.first_rank + before};
  }
  std::uint32_t rank_in(const Entry& entry, std::uint32_t place) const {
    const Part part = part_of(entry, place >> 6);
    return (part.bits >> (place & 63) & 1) == 0 ? kNone : part.rank(place & 63);
  }

  std::uint32_t size_ = 0;
  LatticeBox bounds_;
  LatticePoint least_, most_;
  GrowingArray<Entry> blocks_;
  GrowingArray<std::uint64_t> words_;  // A bit per voxel, in Z-order.
  HashSlots slots_;                    // To blocks_.
};

}  // namespace arris::tiling
