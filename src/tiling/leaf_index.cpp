#include "tiling/leaf_index.h"

#include <algorithm>

namespace arris::tiling {
namespace {

std::size_t hash_of(const LatticePoint& key) {
  std::uint64_t h = static_cast<std::uint32_t>(key.x) * 0x9E3779B97F4A7C15ULL;
  h = (h ^ static_cast<std::uint32_t>(key.y)) * 0xC2B2AE3D27D4EB4FULL;
  h = (h ^ static_cast<std::uint32_t>(key.z)) * 0x165667B19E3779F9ULL;
  return h ^ h >> 32;
}

}  // namespace

LeafIndex::LeafIndex(std::span<const LatticePoint> points, int first_level, int last_level, std::size_t points_per_leaf,
                     std::size_t least_points_per_leaf)
    : level_(first_level) {
  const std::size_t most = std::max<std::size_t>(points.size() / points_per_leaf, 1);
  const std::size_t most_of_the_largest = std::max<std::size_t>(points.size() / least_points_per_leaf, 1);
  rehash(1024);
  leaf_of_.resize(points.size());
  LatticePoint last{};
  std::uint32_t leaf = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    LatticePoint key = key_of(points[i]);
    if (i == 0 || !(key == last)) {
      leaf = find_or_add(key);
      while (keys_.size() > most && level_ < last_level) {
        coarsen(i);
        key = key_of(points[i]);
        leaf = find_or_add(key);
      }
      if (level_ == last_level && keys_.size() > most_of_the_largest) {
        scattered_ = true;
        return;
      }
      last = key;
    }
    leaf_of_[i] = leaf;
  }
}

std::uint32_t LeafIndex::find_or_add(const LatticePoint& key) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(key) & mask;
  for (; slots_[slot] != 0; slot = (slot + 1) & mask) {
    if (keys_[slots_[slot] - 1] == key) return slots_[slot] - 1;
  }
  keys_.push_back(key);
  const auto leaf = static_cast<std::uint32_t>(keys_.size() - 1);
  slots_[slot] = leaf + 1;
  if (keys_.size() * 2 > slots_.size()) rehash(slots_.size() * 2);
  return leaf;
}

void LeafIndex::rehash(std::size_t slots) {
  slots_.assign(slots, 0);
  const std::size_t mask = slots - 1;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    std::size_t slot = hash_of(keys_[i]) & mask;
    while (slots_[slot] != 0) slot = (slot + 1) & mask;
    slots_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

void LeafIndex::coarsen(std::size_t points) {
  ++level_;
  std::vector<LatticePoint> fine;
  fine.swap(keys_);
  slots_.assign(slots_.size(), 0);
  std::vector<std::uint32_t> coarse_of(fine.size());
  for (std::size_t i = 0; i < fine.size(); ++i)
    coarse_of[i] = find_or_add({fine[i].x >> 1, fine[i].y >> 1, fine[i].z >> 1});
  for (std::size_t i = 0; i < points; ++i) leaf_of_[i] = coarse_of[leaf_of_[i]];
}

std::size_t LeafIndex::cubes(int log2) const {
  std::vector<LatticePoint> cubes;
  cubes.reserve(keys_.size());
  for (const LatticePoint& key : keys_) cubes.push_back({key.x >> log2, key.y >> log2, key.z >> log2});
  std::ranges::sort(cubes);
  return static_cast<std::size_t>(std::ranges::unique(cubes).begin() - cubes.begin());
}

LatticePoint LeafIndex::origin(std::size_t leaf) const {
  const LatticePoint& key = keys_[leaf];
  const auto scaled = [&](std::int32_t v) {
    return static_cast<std::int32_t>(std::int64_t{v} * (std::int64_t{1} << level_));
  };
  return {scaled(key.x), scaled(key.y), scaled(key.z)};
}

void LeafIndex::group(PageVector<std::uint32_t>& order, std::vector<std::uint32_t>& begin) {
  begin.assign(keys_.size() + 1, 0);
  for (const std::uint32_t leaf : leaf_of_) ++begin[leaf + 1];
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  order.resize(leaf_of_.size());
  for (std::size_t i = 0; i < leaf_of_.size(); ++i) order[next[leaf_of_[i]]++] = static_cast<std::uint32_t>(i);
  leaf_of_ = {};
}

}  // namespace arris::tiling
