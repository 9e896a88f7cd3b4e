#include "pipeline/nearby_points.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "core/parallel.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {

NearbyPoints::Tile::Tile(tiling::SortedPoints&& of_tile) : points(std::move(of_tile)) {
  points.positions.shrink_to_fit();
  points.ids.shrink_to_fit();
  for (std::size_t begin = 0; begin < points.positions.size(); begin += kBlockPoints) {
    const std::size_t end = std::min(points.positions.size(), begin + kBlockPoints);
    LatticeBox& block = blocks.emplace_back();
    for (std::size_t i = begin; i < end; ++i) block.include(points.positions[i]);
  }
}

NearbyPoints::NearbyPoints(std::vector<tiling::SortedPoints>&& tiles) : tiles_(tiles.size()) {
  for (const tiling::SortedPoints& points : tiles) size_ += points.positions.size();
  parallel_for_chunks(tiles.size(), 1, [&](std::size_t t, std::size_t) { tiles_[t] = Tile(std::move(tiles[t])); });
}

std::optional<TilePoints> NearbyPoints::in(const tiling::QueryRegions& regions, std::uint64_t most_points) const {
  std::vector<tiling::SortedPoints> found(tiles_.size());
  std::atomic<std::uint64_t> count{0};
  parallel_for_chunks(tiles_.size(), 1, [&](std::size_t t, std::size_t) {
    const tiling::SortedPoints& all = tiles_[t].points;
    for (std::size_t block = 0; block < tiles_[t].blocks.size(); ++block) {
      if (count > most_points) return;
      if (!regions.touches(tiles_[t].blocks[block])) continue;
      const std::size_t before = found[t].ids.size();
      const std::size_t end = std::min(all.positions.size(), (block + 1) * kBlockPoints);
      for (std::size_t i = block * kBlockPoints; i < end; ++i) {
        if (!regions.contains(all.positions[i])) continue;
        found[t].positions.push_back(all.positions[i]);
        found[t].ids.push_back(all.ids[i]);
      }
      count += found[t].ids.size() - before;
    }
  });
  if (count > most_points) return std::nullopt;
  LatticePoints positions;
  PointIds ids;
  positions.reserve(count);
  ids.reserve(count);
  for (tiling::SortedPoints& some : found) {
    positions.insert(positions.end(), some.positions.begin(), some.positions.end());
    ids.insert(ids.end(), some.ids.begin(), some.ids.end());
    some = {};
  }
  TilePoints points;
  tiling::fold_duplicates(std::move(positions), std::move(ids), points);
  // Complete around every query as far as the query asked for, which is what its proof needs.
  constexpr std::int64_t kEverywhere = std::int64_t{1} << 40;
  points.core = {{-kEverywhere, -kEverywhere, -kEverywhere}, {kEverywhere, kEverywhere, kEverywhere}};
  points.covered = points.core;
  return points;
}

}  // namespace arris::pipeline
