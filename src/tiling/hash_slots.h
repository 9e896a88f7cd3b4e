#pragma once
/// @file The slots of a hash table whose elements lie in an array elsewhere.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/parallel.h"
#include "core/prefetch.h"
#include "tiling/page_array.h"

namespace arris::tiling {

/// Open addressing from 32-bit hashes to indices below a limit. The upper bits of a hash choose a cache line of 16
/// slots, so that elements whose hashes differ in the low bits only lie together. A slot holds an index and, in the
/// bits that indices do not need, low bits of the hash, so that other elements are seldom looked at. 4 bytes per slot.
/// Slots should be twice the elements, and must be more.
class HashSlots {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  HashSlots() = default;
  /// @param limit  indices are below, < 2^32.
  HashSlots(std::size_t slots, std::size_t limit)
      : lines_(slots / kLine + 1),
        slots_(lines_ * kLine),
        index_bits_(static_cast<int>(std::bit_width(limit))),
        mask_(static_cast<std::uint32_t>((std::uint64_t{1} << index_bits_) - 1)) {
    const std::span<std::uint32_t> all = slots_.first(size());
    parallel_for_chunks(all.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      std::ranges::fill(all.subspan(begin, end - begin), kNone);
    });
  }

  std::size_t size() const { return lines_ * kLine; }
  void prefetch(std::uint32_t hash) const { arris::prefetch(&slots_[home(hash)]); }

  /// The slot of the element for which same(index) is true, or the free slot where it would be. Needs size() > 0.
  template <class Same>
  std::size_t find(std::uint32_t hash, Same&& same) const {
    const std::uint32_t* const slots = &slots_[0];
    const std::size_t end = size();
    const std::uint32_t tag = tag_of(hash), mask = mask_;
    for (std::size_t slot = home(hash);; slot = slot + 1 == end ? 0 : slot + 1) {
      const std::uint32_t held = slots[slot];
      if ((held & mask) == mask || ((held & ~mask) == tag && same(held & mask))) return slot;
    }
  }
  /// Index in a slot, kNone if it is free.
  std::uint32_t at(std::size_t slot) const {
    const std::uint32_t index = slots_[slot] & mask_;
    return index == mask_ ? kNone : index;
  }
  /// The index that a search looks at first, kNone if there is none.
  std::uint32_t first(std::uint32_t hash) const { return at(home(hash)); }
  void set(std::size_t slot, std::uint32_t hash, std::uint32_t index) { slots_[slot] = tag_of(hash) | index; }

 private:
  std::size_t home(std::uint32_t hash) const {
    const auto line = static_cast<std::size_t>(std::uint64_t{hash} * lines_ >> 32);
    return line * kLine + ((2 * hash + (hash >> 3)) & (kLine - 1));
  }
  std::uint32_t tag_of(std::uint32_t hash) const {
    return static_cast<std::uint32_t>(std::uint64_t{hash} << index_bits_);
  }

  static constexpr std::size_t kLine = 16;
  static constexpr std::size_t kGrain = std::size_t{256} << 10;

  std::size_t lines_ = 0;
  PageArray<std::uint32_t> slots_;
  int index_bits_ = 0;
  std::uint32_t mask_ = 0;  // Of the index; all ones: free.
};

}  // namespace arris::tiling
