#include "tiling/query_regions.h"

#include <algorithm>
#include <bit>

namespace arris::tiling {
namespace {

std::uint64_t mix(std::uint64_t value) {  // splitmix64's finaliser
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31);
}

/// Never 0. A collision only makes contains() say yes too often, which is allowed.
std::uint64_t cell_key(int level, std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t key = mix(static_cast<std::uint64_t>(x) + 0x9e3779b97f4a7c15U * static_cast<std::uint64_t>(level + 1));
  key = mix(key ^ static_cast<std::uint64_t>(y) * 0xff51afd7ed558ccdU);
  key = mix(key ^ static_cast<std::uint64_t>(z) * 0xc4ceb9fe1a85ec53U);
  return key | 1U;
}

}  // namespace

void QueryRegions::add(const LatticePoint& position, std::int64_t reach_steps) {
  // The largest power of two that is at most the reach.
  const auto reach = static_cast<std::uint64_t>(std::max<std::int64_t>(reach_steps, 1));
  const int level = std::min(kLevels - 1, static_cast<int>(std::bit_width(reach)) - 1);
  levels_ |= std::uint64_t{1} << level;
  LatticeBox box;
  box.include(position);
  box = box.expanded(reach_steps);
  boxes_.push_back(box);
  std::array<std::int64_t, 3> low{};
  std::array<std::int64_t, 3> high{};
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = box.min[axis] >> level;
    high[axis] = (box.max[axis] - 1) >> level;
    box.min[axis] = low[axis] * (std::int64_t{1} << level);
    box.max[axis] = (high[axis] + 1) * (std::int64_t{1} << level);
  }
  bounds_.include(box);
  for (std::int64_t x = low[0]; x <= high[0]; ++x) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        const std::uint64_t key = cell_key(level, x, y, z);
        if (!has(key)) insert(key);
      }
    }
  }
}

bool QueryRegions::contains(const LatticePoint& p) const {
  if (!bounds_.contains(p)) return false;
  for (std::uint64_t levels = levels_; levels != 0; levels &= levels - 1) {
    const int level = std::countr_zero(levels);
    if (has(cell_key(level, std::int64_t{p.x} >> level, std::int64_t{p.y} >> level, std::int64_t{p.z} >> level)))
      return true;
  }
  return false;
}

bool QueryRegions::touches(const LatticeBox& box) const {
  if (!bounds_.intersects(box)) return false;
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const LatticeBox& query) { return query.intersects(box); });
}

bool QueryRegions::has(std::uint64_t key) const {
  if (table_.empty()) return false;
  const std::size_t mask = table_.size() - 1;
  for (std::size_t slot = key >> 7 & mask; table_[slot] != 0; slot = (slot + 1) & mask) {
    if (table_[slot] == key) return true;
  }
  return false;
}

void QueryRegions::insert(std::uint64_t key) {
  if (2 * (used_ + 1) > table_.size()) grow();
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = key >> 7 & mask;
  while (table_[slot] != 0) slot = (slot + 1) & mask;
  table_[slot] = key;
  ++used_;
}

void QueryRegions::grow() {
  std::vector<std::uint64_t> old(std::max<std::size_t>(64, 2 * table_.size()), 0);
  old.swap(table_);
  const std::size_t mask = table_.size() - 1;
  for (const std::uint64_t key : old) {
    if (key == 0) continue;
    std::size_t slot = key >> 7 & mask;
    while (table_[slot] != 0) slot = (slot + 1) & mask;
    table_[slot] = key;
  }
}

}  // namespace arris::tiling
