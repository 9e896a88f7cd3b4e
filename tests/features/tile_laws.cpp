#include "tile_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace arris {

void PrintTo(const ContourRecord& r, std::ostream* out) {
  *out << "{id " << r.id << " classes " << int{r.classes} << " votes " << r.votes << " gap " << r.gap_deg
       << " strength " << r.fold_strength << " angle " << r.fold_angle_deg << " score " << r.score << " to edge "
       << r.to_edge[0] << " " << r.to_edge[1] << " " << r.to_edge[2] << "}";
}

namespace test {

void expect_equal(const TileContours& a, const TileContours& b) {
  RC_ASSERT(a.isolated == b.isolated);
  RC_CLASSIFY(!a.records.empty(), "has contours");
  RC_ASSERT(a.records.size() == b.records.size());
  for (std::size_t i = 0; i < a.records.size(); ++i) {
    if (a.records[i] == b.records[i]) continue;
    RC_FAIL(testing::PrintToString(a.records[i]) + " is not " + testing::PrintToString(b.records[i]));
  }
}

TilePoints reordered(const TilePoints& tile, std::uint64_t seed) {
  std::vector<std::uint32_t> order(tile.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
  TilePoints shuffled = tile;
  std::vector<std::uint32_t> now_at(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    shuffled.positions[i] = tile.positions[order[i]];
    shuffled.ids[i] = tile.ids[order[i]];
    now_at[order[i]] = i;
  }
  for (auto& [id, entry] : shuffled.duplicates) entry = now_at[entry];
  std::reverse(shuffled.duplicates.begin(), shuffled.duplicates.end());
  return shuffled;
}

LatticePoints anywhere(std::span<const LatticePoint> positions) {
  LatticePoints moved(positions.begin(), positions.end());
  LatticeBox box;
  for (const LatticePoint& p : moved) box.include(p);
  const auto shift = [&](int axis) {
    const auto low = static_cast<std::int64_t>(INT32_MIN) - box.min[axis];
    const auto high = static_cast<std::int64_t>(INT32_MAX) + 1 - box.max[axis];
    return *rc::gen::element(low, high, any(low, high));
  };
  const std::int64_t by[3] = {shift(0), shift(1), shift(2)};
  for (LatticePoint& p : moved) {
    p = {static_cast<std::int32_t>(p.x + by[0]), static_cast<std::int32_t>(p.y + by[1]),
         static_cast<std::int32_t>(p.z + by[2])};
  }
  return moved;
}

TilePoints part_of(const TilePoints& tile, const LatticeBox& core, std::int64_t halo) {
  TilePoints part;
  part.core = core;
  part.covered = core.expanded(halo);
  std::map<std::uint32_t, std::uint32_t> entry_of;
  for (std::uint32_t i = 0; i < tile.positions.size(); ++i) {
    if (!part.covered.contains(tile.positions[i])) continue;
    entry_of[i] = static_cast<std::uint32_t>(part.positions.size());
    part.positions.push_back(tile.positions[i]);
    part.ids.push_back(tile.ids[i]);
  }
  for (const auto& [id, entry] : tile.duplicates) {
    if (entry_of.count(entry)) part.duplicates.emplace_back(id, entry_of[entry]);
  }
  return part;
}

TilePoints part_of(const TilePoints& tile, const UnprovenQuery& query) {
  const LatticePoint& p = query.position;
  return part_of(tile, LatticeBox{{p.x, p.y, p.z}, {p.x + 1LL, p.y + 1LL, p.z + 1LL}}, query.reach_steps);
}

void merge(std::map<std::uint64_t, ContourRecord>& into, const ContourRecords& records) {
  for (const ContourRecord& record : records) {
    const auto [found, fresh] = into.try_emplace(record.id, record);
    if (!fresh) combine(found->second, record);
  }
}

}  // namespace test
}  // namespace arris
