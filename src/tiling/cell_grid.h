#pragma once
/// @file Counts in the cells of one level. Private to CellCounts: includes OpenVDB.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "tiling/cell_leaf_cache.h"
#include "tiling/cell_tree.h"

namespace arris::tiling {

/// Sparse counts of any size: what does not fit 32 bits is kept apart. Not thread-safe.
class CellGrid {
 public:
  CellGrid() = default;
  CellGrid(const CellGrid& other) : tree_(other.tree_), leaves_(other.leaves_), overflow_(other.overflow_) {}
  CellGrid& operator=(const CellGrid&) = delete;

  std::size_t leaves() const { return leaves_; }
  std::size_t active_cells() const { return tree_.onVoxelCount(); }

  void add(const Cell& cell, std::uint64_t count) {
    const CellLeafCache::Entry& leaf = touch_leaf(cell);
    const openvdb::Index offset = offset_in_leaf(cell[0], cell[1], cell[2]);
    std::int32_t& stored = leaf.counts[offset];
    if (stored == 0) leaf.leaf->setActiveState(offset, true);  // Most are active already.
    const std::uint64_t sum = static_cast<std::uint64_t>(stored) + count;
    stored = static_cast<std::int32_t>(sum < kCarry ? sum : carry(cell, sum));
  }

  /// Calls emptied() if the cell's last point went. Returns how many of `count` points were there.
  template <typename Emptied>
  std::uint64_t take(const Cell& cell, std::uint64_t count, Emptied&& emptied);

  std::uint64_t count_at(const Cell& cell) const;

  /// Every cell becomes an eighth of a larger one. The memory of leaves serves the next ones.
  void coarsen();

  /// In an order that depends on the set of leaves only.
  std::vector<const CellLeaf*> list_leaves() const;
  /// Of a cell of a leaf.
  std::uint64_t count_at(const CellLeaf& leaf, openvdb::Index offset) const {
    return static_cast<std::uint64_t>(leaf.buffer().data()[offset]) + carried(leaf, offset);
  }
  /// Calls visit(offset, count) for the cells of a leaf that are not empty, ascending.
  template <typename Visit>
  void for_each_in(const CellLeaf& leaf, Visit&& visit) const {
    const std::int32_t* const counts = leaf.buffer().data();
    for (auto on = leaf.getValueMask().beginOn(); on; ++on)
      visit(on.pos(), static_cast<std::uint64_t>(counts[on.pos()]) + carried(leaf, on.pos()));
  }

 private:
  // Part of a cell's count that moves to the overflow map in one go; small enough that adding one can never overflow
  // int32.
  static constexpr std::uint64_t kCarry = std::uint64_t{1} << 30;

  const CellLeafCache::Entry* probe_leaf(const Cell& cell) {
    const std::int32_t x = cell[0] >> kCellLeafLog2, y = cell[1] >> kCellLeafLog2, z = cell[2] >> kCellLeafLog2;
    if (const CellLeafCache::Entry* const met = cache_.find(x, y, z)) return met;
    CellLeaf* const leaf = tree_.probeLeaf(openvdb::Coord(cell[0], cell[1], cell[2]));
    return leaf ? &cache_.put(x, y, z, *leaf) : nullptr;
  }
  const CellLeafCache::Entry& touch_leaf(const Cell& cell) {
    const CellLeafCache::Entry* const leaf = probe_leaf(cell);
    return leaf ? *leaf : add_leaf(cell);
  }
  const CellLeafCache::Entry& add_leaf(const Cell& cell);
  std::uint64_t carry(const Cell& cell, std::uint64_t sum);
  std::uint64_t carried(const Cell& cell) const;
  std::uint64_t carried(const CellLeaf& leaf, openvdb::Index offset) const {
    if (overflow_.empty()) return 0;
    const openvdb::Coord at = leaf.offsetToGlobalCoord(offset);
    return carried({at.x(), at.y(), at.z()});
  }
  void add_coarsened(const CellLeaf& fine);

  CellTree tree_{0};
  std::size_t leaves_ = 0;
  std::map<Cell, std::uint64_t> overflow_;  // Multiples of kCarry that are not in the tree.
  CellLeafCache cache_;
};

template <typename Emptied>
std::uint64_t CellGrid::take(const Cell& cell, std::uint64_t count, Emptied&& emptied) {
  const CellLeafCache::Entry* const leaf = probe_leaf(cell);
  const openvdb::Index offset = offset_in_leaf(cell[0], cell[1], cell[2]);
  if (!leaf || !leaf->leaf->isValueOn(offset)) return 0;
  std::int32_t& stored = leaf->counts[offset];
  std::uint64_t taken = 0;
  for (;;) {
    const std::uint64_t now = std::min<std::uint64_t>(count - taken, static_cast<std::uint64_t>(stored));
    stored -= static_cast<std::int32_t>(now);
    taken += now;
    if (stored > 0) return taken;
    if (carried(cell) == 0) {
      leaf->leaf->setActiveState(offset, false);
      emptied();
      return taken;
    }
    if (taken == count) return taken;
    const auto found = overflow_.find(cell);  // Borrow.
    found->second -= kCarry;
    if (found->second == 0) overflow_.erase(found);
    stored = static_cast<std::int32_t>(kCarry);
  }
}

}  // namespace arris::tiling
