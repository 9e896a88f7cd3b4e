#include "tiling/cell_grid.h"

#include <memory>
#include <utility>

#include "core/prefetch.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kLeavesAhead = 2;

void prefetch_counts(const CellLeaf& leaf) {
  const std::int32_t* const counts = leaf.buffer().data();
  constexpr openvdb::Index kCountsOfALine = 64 / sizeof(std::int32_t);
  for (openvdb::Index offset = 0; offset < CellLeaf::SIZE; offset += kCountsOfALine) prefetch(&counts[offset]);
}

}  // namespace

const CellLeafCache::Entry& CellGrid::add_leaf(const Cell& cell) {
  CellLeaf* const leaf = tree_.touchLeaf(openvdb::Coord(cell[0], cell[1], cell[2]));
  ++leaves_;
  return cache_.put(cell[0] >> kCellLeafLog2, cell[1] >> kCellLeafLog2, cell[2] >> kCellLeafLog2, *leaf);
}

/// @return what stays in the tree.
std::uint64_t CellGrid::carry(const Cell& cell, std::uint64_t sum) {
  overflow_[cell] += sum / kCarry * kCarry;
  return sum % kCarry;
}

std::uint64_t CellGrid::carried(const Cell& cell) const {
  if (overflow_.empty()) return 0;
  const auto found = overflow_.find(cell);
  return found == overflow_.end() ? 0 : found->second;
}

std::uint64_t CellGrid::count_at(const Cell& cell) const {
  const CellLeaf* const leaf = tree_.probeConstLeaf(openvdb::Coord(cell[0], cell[1], cell[2]));
  if (!leaf) return 0;
  return static_cast<std::uint64_t>(leaf->getValue(offset_in_leaf(cell[0], cell[1], cell[2]))) + carried(cell);
}

std::vector<const CellLeaf*> CellGrid::list_leaves() const {
  std::vector<const CellLeaf*> leaves;
  leaves.reserve(leaves_);
  tree_.getNodes(leaves);
  return leaves;
}

void CellGrid::coarsen() {
  std::vector<CellLeaf*> stolen;
  tree_.stealNodes(stolen);
  std::vector<std::unique_ptr<CellLeaf>> fine(stolen.begin(), stolen.end());
  tree_.clear();
  const std::map<Cell, std::uint64_t> fine_overflow = std::exchange(overflow_, {});
  cache_.clear();
  leaves_ = 0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (i + kLeavesAhead < fine.size()) prefetch_counts(*fine[i + kLeavesAhead]);
    add_coarsened(*fine[i]);
    fine[i].reset();  // Its memory serves the next coarse one.
  }
  for (const auto& [cell, count] : fine_overflow) add({cell[0] >> 1, cell[1] >> 1, cell[2] >> 1}, count);
}

/// A leaf becomes an eighth of a larger one, in which no other leaf has a part.
void CellGrid::add_coarsened(const CellLeaf& fine) {
  if (fine.getValueMask().isOff()) return;
  const openvdb::Coord& origin = fine.origin();
  const Cell corner{origin.x() >> 1, origin.y() >> 1, origin.z() >> 1};
  const CellLeafCache::Entry& coarse = touch_leaf(corner);
  const openvdb::Index first = offset_in_leaf(corner[0], corner[1], corner[2]);
  const std::int32_t* const counts = fine.buffer().data();
  for (auto on = fine.getValueMask().beginOn(); on; ++on) {
    const auto at = static_cast<std::int32_t>(on.pos());
    const openvdb::Index offset = first + offset_in_leaf(at >> 7, at >> 4 & 3, at >> 1 & 3);
    std::int32_t& stored = coarse.counts[offset];
    if (stored == 0) coarse.leaf->setActiveState(offset, true);
    const std::uint64_t sum = static_cast<std::uint64_t>(stored) + static_cast<std::uint64_t>(counts[at]);
    stored = static_cast<std::int32_t>(
        sum < kCarry ? sum : carry({corner[0] + (at >> 7), corner[1] + (at >> 4 & 3), corner[2] + (at >> 1 & 3)}, sum));
  }
}

}  // namespace arris::tiling
