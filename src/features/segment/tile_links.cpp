#include "features/segment/tile_links.h"

#include <atomic>
#include <utility>

#include "core/parallel.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 4096;

}  // namespace

TileLinks::TileLinks(const TileNeighbourhoods& points, const QueryRings& rings, const Likeness& likeness,
                     std::span<const std::uint8_t> grows, bool offers)
    : points_(points),
      likeness_(likeness),
      grows_(grows),
      makes_offers_(offers),
      sets_(points.size()),
      numbered_(points.size(), 0),
      among_own_(points.size(), 0) {
  std::vector<Part> parts((points.size() + kGrain - 1) / kGrain);
  parallel_for_chunks(points.size(), kGrain, [&](std::size_t first, std::size_t last) {
    Part& part = parts[first / kGrain];
    for (std::size_t i = first; i < last; ++i) {
      const auto slot = static_cast<std::uint32_t>(i);
      if (rings.is_query(slot)) link(slot, part);
    }
  });
  for (const Part& part : parts) {
    isolated_ += part.isolated;
    offers_.insert(offers_.end(), part.offers.begin(), part.offers.end());
  }
}

/// Whoever numbers one, the number is the same.
void TileLinks::number(std::uint32_t slot) {
  std::atomic_ref(numbered_[slot]).store(1, std::memory_order_relaxed);
}

void TileLinks::join(std::uint32_t a, std::uint32_t b) {
  number(a);
  number(b);
  sets_.join(a, b);
}

/// Whether all are seen to be linked with the points of `root` at first sight: what most points end with.
bool TileLinks::all_below(std::uint32_t root, const NeighbourList& neighbours) const {
  for (const std::uint32_t neighbour : neighbours)
    if (sets_.parent(neighbour) != root) return false;
  return true;
}

/// What others link meanwhile shows in what is skipped, but neither in the sets nor in the offers: a point that does
/// not grow is alone in its set.
void TileLinks::link(std::uint32_t slot, Part& part) {
  if (points_.state(slot) != ShapeState::kShaped) {
    ++part.isolated;
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
      number(via);
      part.offers.push_back({joins, via});
    }
  }
  among_own_[slot] = all_linked;
}

}  // namespace arris
