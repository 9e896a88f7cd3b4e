#include "features/segment/query_rings.h"

#include <algorithm>
#include <atomic>
#include <unordered_map>

#include "core/parallel.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 4096;

}  // namespace

QueryRings::QueryRings(const PointTree& tree, const LatticeBox& core)
    : tree_(tree), whole_(core), is_query_(tree.size(), 0) {
  for (std::size_t slot = 0; slot < tree_.size(); ++slot) is_query_[slot] = core.contains(tree_.position(slot));
}

QueryRings::QueryRings(const PointTree& tree, std::span<const PlacedQuery> queries)
    : tree_(tree), is_query_(tree.size(), 0) {
  std::unordered_map<std::uint32_t, std::int64_t> reach_of;
  for (const PlacedQuery& query : queries) reach_of.emplace(query.entry, query.reach_steps);
  for (std::uint32_t slot = 0; slot < tree_.size(); ++slot) {
    const auto found = reach_of.find(tree_.entry(slot));
    if (found == reach_of.end()) continue;
    is_query_[slot] = 1;
    listed_.emplace_back(slot, found->second);
  }
}

void QueryRings::compute(TileNeighbourhoods& points, int rings) {
  ring_.resize(tree_.size());
  for (std::uint32_t slot = 0; slot < tree_.size(); ++slot) ring_[slot] = is_query_[slot] ? 0 : kNoRing;
  points.compute(is_query_);
  PageVector<std::uint8_t> wanted(ring_.size());
  for (std::uint8_t ring = 0; ring < rings; ++ring) {
    if (!mark_neighbours(points, ring)) continue;
    for (std::size_t slot = 0; slot < ring_.size(); ++slot) wanted[slot] = ring_[slot] == ring + 1;
    points.compute(wanted);
  }
}

/// Those of a ring that are in none get into the next; false if there are none.
bool QueryRings::mark_neighbours(const TileNeighbourhoods& points, std::uint8_t ring) {
  std::atomic<bool> any{false};
  parallel_for_chunks(tree_.size(), kGrain, [&](std::size_t first, std::size_t last) {
    bool more = false;
    for (std::size_t i = first; i < last; ++i) {
      const auto slot = static_cast<std::uint32_t>(i);
      if (std::atomic_ref(ring_[i]).load(std::memory_order_relaxed) != ring) continue;
      if (ring == 0 && all_queries_around(points, slot)) continue;
      for (const std::uint32_t neighbour : points.neighbours(slot)) {
        // Whoever marks one, the mark is the same.
        const std::atomic_ref mark(ring_[neighbour]);
        if (mark.load(std::memory_order_relaxed) != kNoRing) continue;
        mark.store(ring + 1, std::memory_order_relaxed);
        more = true;
      }
    }
    if (more) any = true;
  });
  return any;
}

/// Whether that is plain without a look at the neighbours, as it is of most: they are no farther than the last of them.
bool QueryRings::all_queries_around(const TileNeighbourhoods& points, std::uint32_t slot) const {
  const auto depth = static_cast<double>(whole_.depth(tree_.position(slot)));
  return points.max_reach_steps() < depth || points.reach_of(slot) < depth;
}

}  // namespace arris
