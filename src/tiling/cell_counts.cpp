#include "tiling/cell_counts.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "tiling/cell_grid.h"
#include "tiling/cell_level.h"

namespace arris::tiling {

struct CellCounts::Impl {
  Impl(int first_level, std::size_t most_leaves)
      : level(std::clamp(first_level, 0, kMaxCellLevel)), max_leaves(std::max<std::size_t>(most_leaves, 1)) {}

  int level;
  std::size_t max_leaves;
  std::uint64_t total = 0;
  CellGrid grid;

  void coarsen() {
    grid.coarsen();
    ++level;
  }
  void coarsen_to_fit() {
    while (grid.leaves() > max_leaves && level < kMaxCellLevel) coarsen();
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
  return impl_->grid.active_cells();
}

void CellCounts::add(std::span<const LatticePoint> points) {
  Impl& impl = *impl_;
  if (impl.total == 0) impl.level = level_that_fits(points, impl.level, impl.max_leaves);
  for (std::size_t begin = 0; begin < points.size();) {
    const Cell cell = cell_of(points[begin], impl.level);
    const std::size_t end = end_of_run(points, begin, impl.level);
    impl.grid.add(cell, end - begin);
    impl.coarsen_to_fit();
    begin = end;
  }
  impl.total += points.size();
}

void CellCounts::add(const LatticePoint& point, std::uint64_t count) {
  if (count == 0) return;
  impl_->grid.add(cell_of(point, impl_->level), count);
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
    const std::uint64_t there = impl.grid.take(cell, end - begin, [&] { emptied(cell_box(cell, level)); });
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
  for (const CellLeaf* leaf : impl_->grid.list_leaves()) {
    impl_->grid.for_each_in(*leaf, [&](openvdb::Index, std::uint64_t points) {
      if (points < kFew) {
        ++with_few[points];
      } else {
        ++with_many[points];
      }
    });
  }
  std::vector<CellClass> classes;
  for (std::size_t points = 0; points < kFew; ++points) {
    if (with_few[points] > 0) classes.push_back({points, with_few[points]});
  }
  for (const auto& [points, cells] : with_many) classes.push_back({points, cells});
  return classes;
}

std::uint64_t CellCounts::count_at(const LatticePoint& position) const {
  return impl_->grid.count_at(cell_of(position, impl_->level));
}

CellCounts CellCounts::coarsened(int level) const {
  auto copy = std::make_unique<Impl>(*impl_);
  while (copy->level < std::min(level, kMaxCellLevel)) copy->coarsen();
  return CellCounts(std::move(copy));
}

void CellCounts::for_each_by_leaf(const std::function<void(const LatticeBox& cell, std::uint64_t count)>& visit) const {
  for (const CellLeaf* leaf : impl_->grid.list_leaves()) {
    impl_->grid.for_each_in(*leaf, [&](openvdb::Index offset, std::uint64_t count) {
      const openvdb::Coord at = leaf->offsetToGlobalCoord(offset);
      visit(cell_box({at.x(), at.y(), at.z()}, impl_->level), count);
    });
  }
}

void CellCounts::for_each(const std::function<void(const LatticeBox& cell, std::uint64_t count)>& visit) const {
  // Ascending order without a list of all cells: leaves are sorted, then rows of leaves are walked plane by plane.
  std::vector<const CellLeaf*> leaves = impl_->grid.list_leaves();
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
      visit(cell_box(cell, impl_->level), impl_->grid.count_at(leaf, offset));
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
