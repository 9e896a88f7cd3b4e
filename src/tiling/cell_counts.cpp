#include "tiling/cell_counts.h"

#include <algorithm>
#include <array>
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
  return impl_->grid.occupied_cells();
}
std::size_t CellCounts::memory_bytes() const {
  return impl_->grid.memory_bytes();
}

void CellCounts::add(std::span<const LatticePoint> points) {
  Impl& impl = *impl_;
  if (impl.total == 0) impl.level = level_that_fits(points, impl.level, impl.max_leaves);
  std::array<CellRun, CellGrid::kMostRuns> runs;
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t count = 0;
    for (; count < runs.size() && begin < points.size(); ++count) {
      const std::size_t end = end_of_run(points, begin, impl.level);
      runs[count] = {cell_of(points[begin], impl.level), end - begin};
      begin = end;
    }
    impl.grid.add(std::span(runs).first(count));
    impl.coarsen_to_fit();
  }
  impl.total += points.size();
}

void CellCounts::add(const CellRuns& runs) {
  Impl& impl = *impl_;
  while (impl.level < runs.level()) impl.coarsen();
  std::array<CellRun, CellGrid::kMostRuns> coarser;
  for (std::span<const CellRun> left = runs.runs(); !left.empty();) {
    const std::span<const CellRun> now = left.first(std::min(left.size(), coarser.size()));
    left = left.subspan(now.size());
    if (const int levels = impl.level - runs.level(); levels == 0) {
      impl.grid.add(now);
    } else {
      std::ranges::transform(now, coarser.begin(), [&](const CellRun& run) {
        return CellRun{cell_coarsened(run.cell, levels), run.points};
      });
      impl.grid.add(std::span(coarser).first(now.size()));
    }
    impl.coarsen_to_fit();
  }
  impl.total += runs.points();
}

void CellCounts::add(const LatticePoint& point, std::uint64_t count) {
  if (count == 0) return;
  const CellRun run{cell_of(point, impl_->level), count};
  impl_->grid.add(std::span(&run, 1));
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
  impl_->grid.for_each_count([&](std::uint64_t points) {
    if (points < kFew) {
      ++with_few[points];
    } else {
      ++with_many[points];
    }
  });
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
  if (std::min(level, kMaxCellLevel) <= impl_->level) return CellCounts(std::make_unique<Impl>(*impl_));
  auto coarse = std::make_unique<Impl>(impl_->level + 1, impl_->max_leaves);
  coarse->total = impl_->total;
  coarse->grid = impl_->grid.coarsened();
  while (coarse->level < std::min(level, kMaxCellLevel)) coarse->coarsen();
  return CellCounts(std::move(coarse));
}

void CellCounts::for_each_by_leaf(const std::function<void(const LatticeBox& cell, std::uint64_t count)>& visit) const {
  for (const CellLeaf* leaf : impl_->grid.list_leaves()) {
    impl_->grid.for_each_in(*leaf, [&](std::uint32_t offset, std::uint64_t count) {
      visit(cell_box(leaf->cell_at(offset), impl_->level), count);
    });
  }
}

void CellCounts::for_each(const std::function<void(const LatticeBox& cell, std::uint64_t count)>& visit) const {
  // Ascending order without a list of all cells: rows of leaves are walked plane by plane.
  const std::vector<const CellLeaf*> leaves = impl_->grid.list_leaves();
  const auto same = [&](std::size_t a, std::size_t b, std::size_t axes) {
    return std::equal(leaves[a]->origin.begin(), leaves[a]->origin.begin() + static_cast<std::ptrdiff_t>(axes),
                      leaves[b]->origin.begin());
  };
  const auto visit_column = [&](const CellLeaf& leaf, std::uint32_t dx, std::uint32_t dy) {
    for (std::uint32_t dz = 0; dz < CellLeaf::kSide; ++dz) {
      const std::uint32_t offset = dx << 6 | dy << 3 | dz;
      if (!leaf.is_occupied(offset)) continue;
      visit(cell_box(leaf.cell_at(offset), impl_->level), impl_->grid.count_at(leaf, offset));
    }
  };
  for (std::size_t slab = 0, slab_end = 0; slab < leaves.size(); slab = slab_end) {
    while (slab_end < leaves.size() && same(slab, slab_end, 1)) ++slab_end;
    for (std::uint32_t dx = 0; dx < CellLeaf::kSide; ++dx) {
      for (std::size_t row = slab, row_end = slab; row < slab_end; row = row_end) {
        while (row_end < slab_end && same(row, row_end, 2)) ++row_end;
        for (std::uint32_t dy = 0; dy < CellLeaf::kSide; ++dy) {
          for (std::size_t leaf = row; leaf < row_end; ++leaf) visit_column(*leaves[leaf], dx, dy);
        }
      }
    }
  }
}

}  // namespace arris::tiling
