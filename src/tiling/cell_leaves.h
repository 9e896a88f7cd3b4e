#pragma once
/// @file Leaves of cells, found by where they lie.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "tiling/cell.h"

namespace arris::tiling {

/// Counts of 8 x 8 x 8 cells, as far as they fit.
struct CellLeaf {
  static constexpr std::uint32_t kSide = 1U << kCellLeafLog2;
  static constexpr std::uint32_t kCells = kSide * kSide * kSide;

  std::array<std::uint16_t, kCells> counts{};
  std::array<std::uint64_t, kCells / 64> occupied{};  ///< A bit per cell.
  Cell origin{};                                      ///< Its least cell.
  bool carries = false;  ///< Counts of some of its cells are higher: CellGrid has the rest.

  static std::uint32_t offset_of(const Cell& cell) {
    return static_cast<std::uint32_t>((cell[0] & 7) << 6 | (cell[1] & 7) << 3 | (cell[2] & 7));
  }
  Cell cell_at(std::uint32_t offset) const {
    return {origin[0] + static_cast<std::int32_t>(offset >> 6), origin[1] + static_cast<std::int32_t>(offset >> 3 & 7),
            origin[2] + static_cast<std::int32_t>(offset & 7)};
  }

  bool is_occupied(std::uint32_t offset) const { return (occupied[offset >> 6] >> (offset & 63) & 1) != 0; }
  void occupy(std::uint32_t offset) { occupied[offset >> 6] |= std::uint64_t{1} << (offset & 63); }
  void vacate(std::uint32_t offset) { occupied[offset >> 6] &= ~(std::uint64_t{1} << (offset & 63)); }
  /// Calls visit(offset), ascending.
  template <typename Visit>
  void for_each_occupied(Visit&& visit) const {
    for (std::uint32_t word = 0; word < occupied.size(); ++word) {
      for (std::uint64_t bits = occupied[word]; bits != 0; bits &= bits - 1) {
        visit(word * 64 + static_cast<std::uint32_t>(std::countr_zero(bits)));
      }
    }
  }
};

/// A hash of their positions finds them; leaves stay where they are in memory. 1.1 kB and up to 100 bytes each. Not
/// thread-safe.
class CellLeaves {
 public:
  CellLeaves() = default;
  CellLeaves(const CellLeaves& other);
  CellLeaves& operator=(const CellLeaves&) = delete;
  CellLeaves(CellLeaves&&) noexcept = default;
  CellLeaves& operator=(CellLeaves&&) noexcept = default;

  std::size_t size() const { return leaves_.size(); }
  std::size_t memory_bytes() const { return leaves_.size() * sizeof(CellLeaf) + slots_.size() * sizeof(Slot); }
  /// The leaf of a cell, null if there is none.
  CellLeaf* find(const Cell& cell) const { return slots_.empty() ? nullptr : slots_[slot_of(position_of(cell))].leaf; }
  /// The same; one of empty cells is made where there is none.
  CellLeaf& touch(const Cell& cell) {
    CellLeaf* const leaf = find(cell);
    return leaf ? *leaf : add(cell);
  }
  /// In the order in which they were made.
  const std::vector<std::unique_ptr<CellLeaf>>& all() const { return leaves_; }
  /// All of them; none is left here.
  std::vector<std::unique_ptr<CellLeaf>> take();

 private:
  struct Slot {
    Cell position{};
    CellLeaf* leaf = nullptr;
  };
  static Cell position_of(const Cell& cell) {
    return {cell[0] >> kCellLeafLog2, cell[1] >> kCellLeafLog2, cell[2] >> kCellLeafLog2};
  }
  /// Comparing arrays is a call of memcmp() otherwise.
  static bool differ(const Cell& a, const Cell& b) { return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) != 0; }
  /// Of the leaf there, or the empty one where it belongs.
  std::size_t slot_of(const Cell& position) const {
    const std::uint32_t hash = static_cast<std::uint32_t>(position[0]) * 0x9E3779B1U ^
                               static_cast<std::uint32_t>(position[1]) * 0x85EBCA77U ^
                               static_cast<std::uint32_t>(position[2]) * 0xC2B2AE3DU;
    std::size_t slot = hash >> shift_;
    while (slots_[slot].leaf && differ(slots_[slot].position, position)) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  CellLeaf& add(const Cell& cell);
  /// For all leaves; `count` is a power of two and more than they are.
  void make_slots(std::size_t count);

  std::vector<std::unique_ptr<CellLeaf>> leaves_;
  std::vector<Slot> slots_;  // None, or a power of two and twice as many as leaves at least.
  int shift_ = 0;            // Of a hash to the number of a slot.
};

}  // namespace arris::tiling
