#include "pipeline/tile_retirement.h"

#include <algorithm>

namespace arris::pipeline {
namespace {

/// Of tiles near each other, per tile; a tile of a surface has 8 around it.
constexpr std::uint64_t kMostPairsPerTile = 256;

}  // namespace

TileRetirement::TileRetirement(const tiling::TilePlan& plan, std::int64_t farthest_steps, bool asks_again)
    : tiles_(plan.tiles),
      farthest_steps_(farthest_steps),
      asks_again_(asks_again),
      cores_(plan.tiles.size(), [&](std::size_t tile) { return plan.tiles[tile].core; }),
      waits_for_(plan.tiles.size()) {
  std::uint64_t pairs = 0;
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    for_each_touching(tiles_[tile].core.expanded(farthest_steps_), [&](std::size_t) { ++waits_for_[tile]; });
    pairs += waits_for_[tile];
    if (pairs <= kMostPairsPerTile * tiles_.size()) continue;
    waits_for_.clear();
    return;
  }
}

std::vector<std::size_t> TileRetirement::analysed(std::size_t tile, std::span<const UnprovenQuery> unproven) {
  std::vector<std::size_t> gone;
  if (waits_for_.empty()) return gone;
  keep_what_is_reached(unproven);
  for_each_touching(tiles_[tile].core.expanded(farthest_steps_), [&](std::size_t other) {
    if (waits_for_[other] != kKept && --waits_for_[other] == 0) gone.push_back(other);
  });
  return gone;
}

void TileRetirement::keep_what_is_reached(std::span<const UnprovenQuery> unproven) {
  for (const UnprovenQuery& query : unproven) {
    LatticeBox box;
    box.include(query.position);
    std::int64_t reach = query.reach_steps;
    if (asks_again_)
      reach = query.most_reach_steps > 0 ? std::min(query.most_reach_steps, farthest_steps_) : farthest_steps_;
    for_each_touching(box.expanded(reach), [&](std::size_t other) { waits_for_[other] = kKept; });
  }
}

}  // namespace arris::pipeline
