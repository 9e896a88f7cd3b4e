#include "tiling/cell_counts.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "tiling/cell_level.h"
#include "tiling/cell_tree.h"

namespace arris::tiling {
namespace {

// Part of a cell's count that moves to the overflow map in one go; small enough that adding one can never overflow
// int32.
constexpr std::int32_t kCarry = 1 << 30;

std::vector<const CellLeaf*> leaves_of(const CellTree& tree) {
  std::vector<const CellLeaf*> leaves;
  leaves.reserve(tree.leafCount());
  tree.getNodes(leaves);
  return leaves;
}

}  // namespace

struct CellCounts::Impl {
  Impl(int first_level, std::size_t most_leaves)
      : level(std::clamp(first_level, 0, kMaxCellLevel)), max_leaves(std::max<std::size_t>(most_leaves, 1)) {}

  int level;
  std::size_t max_leaves;
  std::size_t leaves = 0;
  std::uint64_t total = 0;
  std::unique_ptr<CellTree> tree = std::make_unique<CellTree>(0);
  std::map<Cell, std::uint64_t> overflow;  // Multiples of kCarry that are not in the tree.
  CellLeafCache cache;

  CellLeaf* probe_leaf(std::int32_t cx, std::int32_t cy, std::int32_t cz) {
    const std::int32_t lx = cx >> kCellLeafLog2, ly = cy >> kCellLeafLog2, lz = cz >> kCellLeafLog2;
    if (CellLeaf* leaf = cache.find(lx, ly, lz)) return leaf;
    CellLeaf* leaf = tree->probeLeaf(openvdb::Coord(cx, cy, cz));
    if (leaf) cache.put(lx, ly, lz, leaf);
    return leaf;
  }

  CellLeaf* touch_leaf(std::int32_t cx, std::int32_t cy, std::int32_t cz) {
    if (CellLeaf* leaf = probe_leaf(cx, cy, cz)) return leaf;
    CellLeaf* leaf = tree->touchLeaf(openvdb::Coord(cx, cy, cz));
    ++leaves;
    cache.put(cx >> kCellLeafLog2, cy >> kCellLeafLog2, cz >> kCellLeafLog2, leaf);
    return leaf;
  }

  void add_to_cell(const Cell& cell, std::uint64_t count) {
    CellLeaf* leaf = touch_leaf(cell[0], cell[1], cell[2]);
    const openvdb::Index offset = offset_in_leaf(cell[0], cell[1], cell[2]);
    leaf->setActiveState(offset, true);
    std::int32_t& stored = leaf->buffer().data()[offset];
    const std::uint64_t sum = static_cast<std::uint64_t>(stored) + count;
    const std::uint64_t carried = sum / kCarry * kCarry;
    if (carried > 0) overflow[cell] += carried;
    stored = static_cast<std::int32_t>(sum - carried);
  }

  /// Calls emptied() if the cell's last point went. Returns how many of `count` points were there.
  template <typename Emptied>
  std::uint64_t take_from_cell(const Cell& cell, std::uint64_t count, Emptied&& emptied) {
    CellLeaf* leaf = probe_leaf(cell[0], cell[1], cell[2]);
    const openvdb::Index offset = offset_in_leaf(cell[0], cell[1], cell[2]);
    if (!leaf || !leaf->isValueOn(offset)) return 0;
    std::int32_t& stored = leaf->buffer().data()[offset];
    std::uint64_t taken = 0;
    for (;;) {
      const std::uint64_t now = std::min<std::uint64_t>(count - taken, static_cast<std::uint64_t>(stored));
      stored -= static_cast<std::int32_t>(now);
      taken += now;
      if (stored > 0) return taken;
      if (carried(cell) == 0) {
        leaf->setActiveState(offset, false);
        emptied();
        return taken;
      }
      if (taken == count) return taken;
      const auto found = overflow.find(cell);  // Borrow.
      found->second -= kCarry;
      if (found->second == 0) overflow.erase(found);
      stored = kCarry;
    }
  }

  std::uint64_t carried(const Cell& cell) const {
    if (overflow.empty()) return 0;
    const auto found = overflow.find(cell);
    return found == overflow.end() ? 0 : found->second;
  }

  void coarsen() {
    std::vector<CellLeaf*> stolen;
    tree->stealNodes(stolen);
    std::vector<std::unique_ptr<CellLeaf>> fine(stolen.begin(), stolen.end());
    tree = std::make_unique<CellTree>(0);
    const std::map<Cell, std::uint64_t> fine_overflow = std::exchange(overflow, {});
    cache.clear();
    leaves = 0;
    ++level;
    for (std::unique_ptr<CellLeaf>& leaf : fine) {
      for (auto value = leaf->cbeginValueOn(); value; ++value) {
        const openvdb::Coord at = value.getCoord();
        add_to_cell({at.x() >> 1, at.y() >> 1, at.z() >> 1}, static_cast<std::uint64_t>(*value));
      }
      leaf.reset();  // Its memory serves the next coarse one.
    }
    for (const auto& [cell, count] : fine_overflow) add_to_cell({cell[0] >> 1, cell[1] >> 1, cell[2] >> 1}, count);
  }

  void coarsen_to_fit() {
    while (leaves > max_leaves && level < kMaxCellLevel) coarsen();
  }
};

CellCounts::CellCounts(int first_level, std::size_t max_leaves)
    : impl_(std::make_unique<Impl>(first_level, max_leaves)) {}
CellCounts::CellCounts(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CellCounts::~CellCounts() = default;
CellCounts::CellCounts(CellCounts&&) noexcept = default;
CellCounts& CellCounts::operator=(CellCounts&&) noexcept = default;

int CellCounts::level() const {
  return impl_->level;
}
std::uint64_t CellCounts::total() const {
  return impl_->total;
}
std::size_t CellCounts::active_cells() const {
  return impl_->tree->onVoxelCount();
}

void CellCounts::add(std::span<const LatticePoint> points) {
  Impl& impl = *impl_;
  if (impl.total == 0) impl.level = level_that_fits(points, impl.level, impl.max_leaves);
  for (std::size_t begin = 0; begin < points.size();) {
    const Cell cell = cell_of(points[begin], impl.level);
    const std::size_t end = end_of_run(points, begin, impl.level);
    impl.add_to_cell(cell, end - begin);
    impl.coarsen_to_fit();
    begin = end;
  }
  impl.total += points.size();
}

void CellCounts::add(const LatticePoint& point, std::uint64_t count) {
  if (count == 0) return;
  impl_->add_to_cell(cell_of(point, impl_->level), count);
  impl_->coarsen_to_fit();
  impl_->total += count;
}

std::size_t CellCounts::remove(std::span<const LatticePoint> points,
                               const std::function<void(const LatticeBox& cell)>& emptied) {
  Impl& impl = *impl_;
  const int level = impl.level;
  std::size_t missing = 0;
  for (std::size_t begin = 0; begin < points.size();) {
    const Cell cell = cell_of(points[begin], level);
    const std::size_t end = end_of_run(points, begin, level);
    const std::uint64_t there = impl.take_from_cell(cell, end - begin, [&] { emptied(cell_box(cell, level)); });
    missing += end - begin - there;
    begin = end;
  }
  impl.total -= points.size() - missing;
  return missing;
}

std::vector<CellClass> CellCounts::classes() const {
  constexpr std::size_t kFew = 4096;
  std::vector<std::uint64_t> with_few(kFew);  // Nearly all cells, by their points.
  std::map<std::uint64_t, std::uint64_t> with_many;
  for (const CellLeaf* leaf : leaves_of(*impl_->tree)) {
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      const auto stored = static_cast<std::uint64_t>(*value);
      if (impl_->overflow.empty() && stored < kFew) {
        ++with_few[stored];
        continue;
      }
      const openvdb::Coord at = value.getCoord();
      ++with_many[stored + impl_->carried({at.x(), at.y(), at.z()})];
    }
  }
  for (std::size_t points = 0; points < kFew; ++points) {
    if (with_few[points] > 0) with_many[points] += with_few[points];
  }
  std::vector<CellClass> classes;
  for (const auto& [points, cells] : with_many) classes.push_back({points, cells});
  return classes;
}

std::uint64_t CellCounts::count_at(const LatticePoint& position) const {
  const int level = impl_->level;
  const Cell cell = cell_of(position, level);
  const CellLeaf* leaf = impl_->tree->probeConstLeaf(openvdb::Coord(cell[0], cell[1], cell[2]));
  if (!leaf) return 0;
  return static_cast<std::uint64_t>(leaf->getValue(offset_in_leaf(cell[0], cell[1], cell[2]))) + impl_->carried(cell);
}

CellCounts CellCounts::coarsened(int level) const {
  auto copy = std::make_unique<Impl>(impl_->level, impl_->max_leaves);
  copy->leaves = impl_->leaves;
  copy->total = impl_->total;
  copy->tree = std::make_unique<CellTree>(*impl_->tree);
  copy->overflow = impl_->overflow;
  while (copy->level < std::min(level, kMaxCellLevel)) copy->coarsen();
  return CellCounts(std::move(copy));
}

void CellCounts::for_each_by_leaf(const std::function<void(const LatticeBox& cell, std::uint64_t count)>& visit) const {
  for (const CellLeaf* leaf : leaves_of(*impl_->tree)) {
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      const openvdb::Coord at = value.getCoord();
      const Cell cell{at.x(), at.y(), at.z()};
      visit(cell_box(cell, impl_->level), static_cast<std::uint64_t>(*value) + impl_->carried(cell));
    }
  }
}

void CellCounts::for_each(const std::function<void(const LatticeBox& cell, std::uint64_t count)>& visit) const {
  // Ascending order without a list of all cells: leaves are sorted, then rows of leaves are walked plane by plane.
  std::vector<const CellLeaf*> leaves = leaves_of(*impl_->tree);
  std::ranges::sort(leaves, [](const CellLeaf* a, const CellLeaf* b) { return a->origin() < b->origin(); });
  const auto same = [&](std::size_t a, std::size_t b, int axes) {
    for (int axis = 0; axis < axes; ++axis) {
      if (leaves[a]->origin()[axis] != leaves[b]->origin()[axis]) return false;
    }
    return true;
  };
  const auto visit_column = [&](const CellLeaf& leaf, std::int32_t dx, std::int32_t dy) {
    for (std::int32_t dz = 0; dz < 8; ++dz) {
      const openvdb::Index offset = offset_in_leaf(dx, dy, dz);
      if (!leaf.isValueOn(offset)) continue;
      const openvdb::Coord& origin = leaf.origin();
      const Cell cell{origin.x() + dx, origin.y() + dy, origin.z() + dz};
      visit(cell_box(cell, impl_->level), static_cast<std::uint64_t>(leaf.getValue(offset)) + impl_->carried(cell));
    }
  };
  for (std::size_t slab = 0, slab_end = 0; slab < leaves.size(); slab = slab_end) {
    while (slab_end < leaves.size() && same(slab, slab_end, 1)) ++slab_end;
    for (std::int32_t dx = 0; dx < 8; ++dx) {
      for (std::size_t row = slab, row_end = slab; row < slab_end; row = row_end) {
        while (row_end < slab_end && same(row, row_end, 2)) ++row_end;
        for (std::int32_t dy = 0; dy < 8; ++dy) {
          for (std::size_t leaf = row; leaf < row_end; ++leaf) visit_column(*leaves[leaf], dx, dy);
        }
      }
    }
  }
}

}  // namespace arris::tiling
