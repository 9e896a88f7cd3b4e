#pragma once
/// @file Counts in the cells of one level. Private to CellCounts.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "tiling/cell.h"
#include "tiling/cell_leaves.h"
#include "tiling/cell_runs.h"

namespace arris::tiling {

/// Sparse counts of any size: what does not fit a leaf is kept apart. Not thread-safe.
class CellGrid {
 public:
  static constexpr std::size_t kMostRuns = 64;

  std::size_t leaves() const { return leaves_.size(); }
  std::size_t occupied_cells() const;
  std::size_t memory_bytes() const { return leaves_.memory_bytes(); }

  /// At most kMostRuns of them: memory for the last is fetched while the first are counted.
  void add(std::span<const CellRun> runs);

  /// Calls emptied() if the cell's last point went. Returns how many of `count` points were there.
  template <typename Emptied>
  std::uint64_t take(const Cell& cell, std::uint64_t count, Emptied&& emptied);

  std::uint64_t count_at(const Cell& cell) const;

  /// Every cell becomes an eighth of a larger one. The memory of leaves serves the next ones.
  void coarsen();
  CellGrid coarsened() const;

  /// Ascending by position.
  std::vector<const CellLeaf*> list_leaves() const;
  /// Of a cell of a leaf.
  std::uint64_t count_at(const CellLeaf& leaf, std::uint32_t offset) const {
    return std::uint64_t{leaf.counts[offset]} + carried(leaf, offset);
  }
  /// Calls visit(offset, count) for the cells of a leaf that are not empty, ascending.
  template <typename Visit>
  void for_each_in(const CellLeaf& leaf, Visit&& visit) const {
    leaf.for_each_occupied([&](std::uint32_t offset) { visit(offset, count_at(leaf, offset)); });
  }
  /// Calls visit(count) for all cells that are not empty, in any order.
  template <typename Visit>
  void for_each_count(Visit&& visit) const {
    for (const auto& leaf : leaves_.all()) {
      for_each_in(*leaf, [&](std::uint32_t, std::uint64_t count) { visit(count); });
    }
  }

 private:
  /// Counts in leaves are smaller: whole multiples move to the overflow map, which also lends one.
  static constexpr std::uint64_t kCarry = std::uint64_t{1} << 15;

  void add(CellLeaf& leaf, std::uint32_t offset, std::uint64_t count) {
    std::uint16_t& stored = leaf.counts[offset];
    if (stored == 0) leaf.occupy(offset);  // Most are already.
    const std::uint64_t sum = stored + count;
    stored = static_cast<std::uint16_t>(sum < kCarry ? sum : carry(leaf, offset, sum));
  }
  void add_coarsened(const CellLeaf& fine);
  void add_overflow_coarsened(const std::map<Cell, std::uint64_t>& fine);
  std::uint64_t carry(CellLeaf& leaf, std::uint32_t offset, std::uint64_t sum);
  std::uint64_t carried(const Cell& cell) const;
  std::uint64_t carried(const CellLeaf& leaf, std::uint32_t offset) const {
    return leaf.carries ? carried(leaf.cell_at(offset)) : 0;
  }

  CellLeaves leaves_;
  std::map<Cell, std::uint64_t> overflow_;  // Multiples of kCarry that are not in leaves.
};

template <typename Emptied>
std::uint64_t CellGrid::take(const Cell& cell, std::uint64_t count, Emptied&& emptied) {
  CellLeaf* const leaf = leaves_.find(cell);
  const std::uint32_t offset = CellLeaf::offset_of(cell);
  if (!leaf || !leaf->is_occupied(offset)) return 0;
  std::uint16_t& stored = leaf->counts[offset];
  std::uint64_t taken = 0;
  for (;;) {
    const std::uint64_t now = std::min<std::uint64_t>(count - taken, stored);
    stored = static_cast<std::uint16_t>(stored - now);
    taken += now;
    if (stored > 0) return taken;
    if (carried(*leaf, offset) == 0) {
      leaf->vacate(offset);
      emptied();
      return taken;
    }
    if (taken == count) return taken;
    const auto found = overflow_.find(cell);  // Borrow.
    found->second -= kCarry;
    if (found->second == 0) overflow_.erase(found);
    stored = static_cast<std::uint16_t>(kCarry);
  }
}

}  // namespace arris::tiling
