#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "tiling/fold_sorted.h"
#include "tiling/morton.h"
#include "tiling/tile_store.h"
#include "tiling/z_order_key.h"

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

namespace {

/// The order of (position, id), positions in Z-order.
std::vector<std::uint32_t> z_order(std::span<const LatticePoint> positions, std::span<const std::uint64_t> ids) {
  std::vector<std::uint32_t> order(positions.size());
  LatticePoint least, most;
  if (!positions.empty()) least = most = positions[0];
  for (const LatticePoint& p : positions) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
  }
  if (const std::optional<ZOrderKey> key_of = ZOrderKey::for_range(least, most)) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed(positions.size());
    for (std::uint32_t i = 0; i < keyed.size(); ++i) keyed[i] = {(*key_of)(positions[i]), i};
    std::ranges::sort(keyed, [&](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first : ids[a.second] < ids[b.second];
    });
    std::ranges::transform(keyed, order.begin(), [](const auto& of) { return of.second; });
  } else {
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      return positions[a] != positions[b] ? z_order_less(positions[a], positions[b]) : ids[a] < ids[b];
    });
  }
  return order;
}

}  // namespace

void fold_duplicates(std::vector<LatticePoint>&& positions, std::vector<std::uint64_t>&& ids, TilePoints& tile) {
  const std::vector<std::uint32_t> order = z_order(positions, ids);
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
