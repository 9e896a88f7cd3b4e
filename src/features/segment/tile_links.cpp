#include "features/segment/tile_links.h"

#include <utility>

namespace arris {

TileLinks::TileLinks(const TileNeighbourhoods& points, const QueryRings& rings, const Likeness& likeness,
                     std::span<const std::uint8_t> grows, bool offers)
    : points_(points),
      likeness_(likeness),
      grows_(grows),
      makes_offers_(offers),
      sets_(points.size()),
      numbered_(points.size(), 0),
      among_own_(points.size(), 0) {
  rings.for_each_query([&](std::uint32_t slot) { link(slot); });
}

void TileLinks::join(std::uint32_t a, std::uint32_t b) {
  numbered_[a] = numbered_[b] = 1;
  sets_.join(a, b);
}

/// Whether all are seen to be linked with the points of `root` at first sight: what most points end with.
bool TileLinks::all_below(std::uint32_t root, const NeighbourList& neighbours) const {
  for (const std::uint32_t neighbour : neighbours)
    if (sets_.parent(neighbour) != root) return false;
  return true;
}

void TileLinks::link(std::uint32_t slot) {
  if (points_.state(slot) != ShapeState::kShaped) {
    ++isolated_;
    return;
  }
  std::uint32_t root = sets_.find(slot);
  const NeighbourList neighbours = points_.neighbours(slot);
  if (all_below(root, neighbours)) {
    among_own_[slot] = 1;
    return;
  }
  bool all_linked = true;
  for (const std::uint32_t neighbour : neighbours) {
    if (sets_.parent(neighbour) == root) continue;  // Most are linked already.
    const bool both = grows_[slot] && grows_[neighbour];
    if (both && sets_.find(neighbour) == root) continue;
    if (!(grows_[slot] || grows_[neighbour]) || !alike(slot, neighbour)) {
      all_linked = false;
      continue;
    }
    if (both) {
      join(slot, neighbour);
      root = sets_.find(slot);
      continue;
    }
    all_linked = false;
    if (makes_offers_) {
      const auto [joins, via] = grows_[slot] ? std::pair(neighbour, slot) : std::pair(slot, neighbour);
      numbered_[via] = 1;
      offers_.push_back({joins, via});
    }
  }
  among_own_[slot] = all_linked;
}

}  // namespace arris
