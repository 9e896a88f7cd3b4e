#include "tiling/cell_grid.h"

#include <array>
#include <bit>
#include <memory>
#include <utility>

#include "core/prefetch.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kLeavesAhead = 2;

void prefetch_counts(const CellLeaf& leaf) {
  constexpr std::uint32_t kCountsOfALine = 64 / sizeof(std::uint16_t);
  for (std::uint32_t offset = 0; offset < CellLeaf::kCells; offset += kCountsOfALine) prefetch(&leaf.counts[offset]);
}

}  // namespace

std::size_t CellGrid::occupied_cells() const {
  std::size_t cells = 0;
  for (const auto& leaf : leaves_.all()) {
    for (const std::uint64_t bits : leaf->occupied) cells += static_cast<std::size_t>(std::popcount(bits));
  }
  return cells;
}

void CellGrid::add(std::span<const CellRun> runs) {
  std::array<CellLeaf*, kMostRuns> leaf;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    leaf[i] = &leaves_.touch(runs[i].cell);
    prefetch_to_write(&leaf[i]->counts[CellLeaf::offset_of(runs[i].cell)]);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) add(*leaf[i], CellLeaf::offset_of(runs[i].cell), runs[i].points);
}

/// @return what stays in the leaf.
std::uint64_t CellGrid::carry(CellLeaf& leaf, std::uint32_t offset, std::uint64_t sum) {
  overflow_[leaf.cell_at(offset)] += sum / kCarry * kCarry;
  leaf.carries = true;
  return sum % kCarry;
}

std::uint64_t CellGrid::carried(const Cell& cell) const {
  const auto found = overflow_.find(cell);
  return found == overflow_.end() ? 0 : found->second;
}

std::uint64_t CellGrid::count_at(const Cell& cell) const {
  const CellLeaf* const leaf = leaves_.find(cell);
  return leaf ? count_at(*leaf, CellLeaf::offset_of(cell)) : 0;
}

std::vector<const CellLeaf*> CellGrid::list_leaves() const {
  std::vector<const CellLeaf*> leaves;
  leaves.reserve(leaves_.size());
  for (const auto& leaf : leaves_.all()) leaves.push_back(leaf.get());
  std::ranges::sort(leaves, {}, [](const CellLeaf* leaf) -> const Cell& { return leaf->origin; });
  return leaves;
}

void CellGrid::coarsen() {
  std::vector<std::unique_ptr<CellLeaf>> fine = leaves_.take();
  const std::map<Cell, std::uint64_t> fine_overflow = std::exchange(overflow_, {});
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (i + kLeavesAhead < fine.size()) prefetch_counts(*fine[i + kLeavesAhead]);
    add_coarsened(*fine[i]);
    fine[i].reset();  // Its memory serves the next coarse one.
  }
  add_overflow_coarsened(fine_overflow);
}

CellGrid CellGrid::coarsened() const {
  CellGrid coarse;
  const auto& fine = leaves_.all();
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (i + kLeavesAhead < fine.size()) prefetch_counts(*fine[i + kLeavesAhead]);
    coarse.add_coarsened(*fine[i]);
  }
  coarse.add_overflow_coarsened(overflow_);
  return coarse;
}

void CellGrid::add_overflow_coarsened(const std::map<Cell, std::uint64_t>& fine) {
  for (const auto& [cell, count] : fine) {
    const CellRun run{cell_coarsened(cell, 1), count};
    add(std::span(&run, 1));
  }
}

/// A leaf becomes an eighth of a larger one, in which no other leaf has a part.
void CellGrid::add_coarsened(const CellLeaf& fine) {
  CellLeaf* coarse = nullptr;
  std::uint32_t first = 0;
  fine.for_each_occupied([&](std::uint32_t at) {
    if (!coarse) {
      const Cell corner = cell_coarsened(fine.origin, 1);
      coarse = &leaves_.touch(corner);
      first = CellLeaf::offset_of(corner);
    }
    const std::uint32_t half = (at >> 7) << 6 | (at >> 4 & 3) << 3 | (at >> 1 & 3);
    add(*coarse, first + half, fine.counts[at]);
  });
}

}  // namespace arris::tiling
