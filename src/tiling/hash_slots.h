#pragma once
/// @file The slots of a hash table whose elements lie in an array elsewhere.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace arris::tiling {

/// Open addressing from 32-bit hashes to indices below a limit. A slot holds an index and, in the bits that indices do
/// not need, low bits of the hash, so that other elements are seldom looked at. 4 bytes per slot. Slots must stay more
/// than elements.
class HashSlots {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  HashSlots() = default;
  /// @param limit  indices are below, < 2^32.
  HashSlots(std::size_t slots, std::size_t limit)
      : slots_(slots, kNone),
        size_(slots),
        index_bits_(static_cast<int>(std::bit_width(limit))),
        mask_(static_cast<std::uint32_t>((std::uint64_t{1} << index_bits_) - 1)) {}

  std::size_t size() const { return size_; }
  void prefetch(std::uint32_t hash) const { __builtin_prefetch(&slots_[home(hash)]); }

  /// The slot of the element for which same(index) is true, or the free slot where it would be. Needs size() > 0.
  template <class Same>
  std::size_t find(std::uint32_t hash, Same&& same) const {
    const std::uint32_t* const slots = slots_.data();
    const std::uint32_t tag = tag_of(hash), mask = mask_;
    for (std::size_t slot = home(hash);; slot = slot + 1 == size_ ? 0 : slot + 1) {
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
    return static_cast<std::size_t>(std::uint64_t{hash} * size_ >> 32);
  }
  std::uint32_t tag_of(std::uint32_t hash) const {
    return static_cast<std::uint32_t>(std::uint64_t{hash} << index_bits_);
  }

  std::vector<std::uint32_t> slots_;
  std::size_t size_ = 0;
  int index_bits_ = 0;
  std::uint32_t mask_ = 0;  // Of the index; all ones: free.
};

}  // namespace arris::tiling
