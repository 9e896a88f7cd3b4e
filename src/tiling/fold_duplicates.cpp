#include <algorithm>
#include <numeric>

#include "tiling/fold_sorted.h"
#include "tiling/morton.h"
#include "tiling/tile_store.h"

namespace arris::tiling {

void fold_sorted(std::vector<LatticePoint>&& positions, std::vector<std::uint64_t>&& ids, TilePoints& tile) {
  tile.duplicates.clear();
  std::size_t unique = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (unique > 0 && positions[unique - 1] == positions[i]) {
      tile.duplicates.emplace_back(ids[i], static_cast<std::uint32_t>(unique - 1));
      continue;
    }
    positions[unique] = positions[i];
    ids[unique] = ids[i];
    ++unique;
  }
  positions.resize(unique);
  ids.resize(unique);
  tile.positions = std::move(positions);
  tile.ids = std::move(ids);
}

void fold_duplicates(std::vector<LatticePoint>&& positions, std::vector<std::uint64_t>&& ids, TilePoints& tile) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    if (positions[a] != positions[b]) return z_order_less(positions[a], positions[b]);
    return ids[a] < ids[b];
  });
  std::vector<LatticePoint> sorted_positions(positions.size());
  std::vector<std::uint64_t> sorted_ids(ids.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted_positions[i] = positions[order[i]];
    sorted_ids[i] = ids[order[i]];
  }
  std::vector<LatticePoint>().swap(positions);
  std::vector<std::uint64_t>().swap(ids);
  fold_sorted(std::move(sorted_positions), std::move(sorted_ids), tile);
}

}  // namespace arris::tiling
