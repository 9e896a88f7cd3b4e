#include "tiling/query_regions.h"

#include <algorithm>
#include <array>
#include <bit>

namespace arris::tiling {
namespace {

using CellIndex = std::array<std::int64_t, 3>;

/// Where a box has more cells than that, all balls are tried instead.
constexpr std::int64_t kMostCellsOfABox = 64;

std::uint64_t mix(std::uint64_t value) {  // splitmix64's finaliser
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31);
}

/// Never 0. Cells of equal keys share their balls, which are looked at one by one anyway.
std::uint64_t cell_key(int level, const CellIndex& cell) {
  std::uint64_t key = mix(static_cast<std::uint64_t>(cell[0]) + 0x9e3779b97f4a7c15U * static_cast<unsigned>(level + 1));
  key = mix(key ^ static_cast<std::uint64_t>(cell[1]) * 0xff51afd7ed558ccdU);
  key = mix(key ^ static_cast<std::uint64_t>(cell[2]) * 0xc4ceb9fe1a85ec53U);
  return key | 1U;
}

LatticeBox box_of(int level, const CellIndex& cell) {
  LatticeBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = cell[axis] * (std::int64_t{1} << level);
    box.max[axis] = box.min[axis] + (std::int64_t{1} << level);
  }
  return box;
}

/// Calls visit(cell) for the cells of the level that the box has a part of, until it returns true.
template <typename Visit>
bool any_cell(int level, const LatticeBox& box, Visit&& visit) {
  CellIndex cell{};
  for (cell[0] = box.min[0] >> level; cell[0] <= (box.max[0] - 1) >> level; ++cell[0]) {
    for (cell[1] = box.min[1] >> level; cell[1] <= (box.max[1] - 1) >> level; ++cell[1]) {
      for (cell[2] = box.min[2] >> level; cell[2] <= (box.max[2] - 1) >> level; ++cell[2]) {
        if (visit(cell)) return true;
      }
    }
  }
  return false;
}

std::int64_t cells_of(int level, const LatticeBox& box) {
  std::int64_t cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    cells *= ((box.max[axis] - 1) >> level) - (box.min[axis] >> level) + 1;
    if (cells > kMostCellsOfABox) break;
  }
  return cells;
}

/// Whether a difference of positions is no longer than the reach.
bool within(const std::array<std::int64_t, 3>& difference, std::int64_t reach) {
  std::uint64_t sum = 0;
  for (const std::int64_t d : difference) {
    if (d > reach || -d > reach) return false;
    sum += static_cast<std::uint64_t>(d) * static_cast<std::uint64_t>(d);
  }
  // Of a reach as long as half the lattice the cube is as good: its squares need more than 64 bits.
  return reach >= std::int64_t{1} << 31 || sum <= static_cast<std::uint64_t>(reach) * static_cast<std::uint64_t>(reach);
}

}  // namespace

bool QueryRegions::Ball::contains(const LatticePoint& p) const {
  return within({std::int64_t{p.x} - centre.x, std::int64_t{p.y} - centre.y, std::int64_t{p.z} - centre.z}, reach);
}

bool QueryRegions::Ball::touches(const LatticeBox& box) const {
  std::array<std::int64_t, 3> nearest{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t c = centre[axis];
    nearest[static_cast<std::size_t>(axis)] = std::clamp(c, box.min[axis], box.max[axis] - 1) - c;
  }
  return within(nearest, reach);
}

bool QueryRegions::Ball::fills(const LatticeBox& box) const {
  std::array<std::int64_t, 3> farthest{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t c = centre[axis];
    farthest[static_cast<std::size_t>(axis)] = std::max(c - box.min[axis], box.max[axis] - 1 - c);
  }
  return within(farthest, reach);
}

void QueryRegions::add(const LatticePoint& position, std::int64_t reach_steps) {
  const auto reach = static_cast<std::uint64_t>(std::max<std::int64_t>(reach_steps, 1));
  const int level = std::min(kLevels - 1, static_cast<int>(std::bit_width(reach)) - 1);
  levels_ |= std::uint64_t{1} << level;
  const Ball ball{position, reach_steps};
  const auto index = static_cast<std::uint32_t>(balls_.size());
  balls_.push_back(ball);
  LatticeBox box;
  box.include(position);
  box = box.expanded(reach_steps);
  bounds_.include(box);
  any_cell(level, box, [&](const CellIndex& at) {
    const LatticeBox cell_box = box_of(level, at);
    if (!ball.touches(cell_box)) return false;
    Cell& cell = find_or_add(cell_key(level, at));
    if (cell.first == kFilled) return false;
    if (ball.fills(cell_box)) {
      cell.first = kFilled;
    } else {
      links_.push_back({index, cell.first});
      cell.first = static_cast<std::uint32_t>(links_.size() - 1);
    }
    return false;
  });
}

bool QueryRegions::contains(const LatticePoint& p) const {
  if (!bounds_.contains(p)) return false;
  for (std::uint64_t levels = levels_; levels != 0; levels &= levels - 1) {
    const int level = std::countr_zero(levels);
    const CellIndex at{std::int64_t{p.x} >> level, std::int64_t{p.y} >> level, std::int64_t{p.z} >> level};
    const Cell* cell = find(cell_key(level, at));
    if (cell == nullptr) continue;
    if (cell->first == kFilled) return true;
    for (std::uint32_t link = cell->first; link != kEnd; link = links_[link].next) {
      if (balls_[links_[link].ball].contains(p)) return true;
    }
  }
  return false;
}

bool QueryRegions::touches(const LatticeBox& box) const {
  if (box.empty() || !bounds_.intersects(box)) return false;
  for (std::uint64_t levels = levels_; levels != 0; levels &= levels - 1) {
    const int level = std::countr_zero(levels);
    if (cells_of(level, box) > kMostCellsOfABox)
      return std::ranges::any_of(balls_, [&](const Ball& ball) { return ball.touches(box); });
    const bool found = any_cell(level, box, [&](const CellIndex& at) {
      const Cell* cell = find(cell_key(level, at));
      if (cell == nullptr) return false;
      if (cell->first == kFilled) return true;
      for (std::uint32_t link = cell->first; link != kEnd; link = links_[link].next) {
        if (balls_[links_[link].ball].touches(box)) return true;
      }
      return false;
    });
    if (found) return true;
  }
  return false;
}

const QueryRegions::Cell* QueryRegions::find(std::uint64_t key) const {
  const std::size_t mask = table_.size() - 1;
  for (std::size_t slot = key >> 7 & mask; table_[slot].key != 0; slot = (slot + 1) & mask) {
    if (table_[slot].key == key) return &table_[slot];
  }
  return nullptr;
}

QueryRegions::Cell& QueryRegions::find_or_add(std::uint64_t key) {
  if (2 * (used_ + 1) > table_.size()) grow();
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = key >> 7 & mask;
  for (; table_[slot].key != 0; slot = (slot + 1) & mask) {
    if (table_[slot].key == key) return table_[slot];
  }
  table_[slot] = {key, kEnd};
  ++used_;
  return table_[slot];
}

void QueryRegions::grow() {
  std::vector<Cell> old(std::max<std::size_t>(64, 2 * table_.size()));
  old.swap(table_);
  const std::size_t mask = table_.size() - 1;
  for (const Cell& cell : old) {
    if (cell.key == 0) continue;
    std::size_t slot = cell.key >> 7 & mask;
    while (table_[slot].key != 0) slot = (slot + 1) & mask;
    table_[slot] = cell;
  }
}

}  // namespace arris::tiling
