#include <algorithm>
#include <numeric>

#include "tiling/fold_sorted.h"
#include "tiling/morton.h"
#include "tiling/tile_store.h"

namespace arris::tiling {
namespace {

/// More runs than these are no order to speak of.
constexpr std::size_t kMostRuns = 256;

/// Sorts; quickly what is a few sorted runs one after the other, as the points of several tiles are.
template <class Less>
void sort_runs(PageVector<std::uint32_t>& items, Less&& less) {
  using Place = PageVector<std::uint32_t>::iterator;
  std::vector<Place> ends;  // Of the runs.
  for (Place end = items.begin(); end != items.end();) {
    end = std::is_sorted_until(end, items.end(), less);
    ends.push_back(end);
    if (ends.size() > kMostRuns) {
      std::sort(items.begin(), items.end(), less);
      return;
    }
  }
  while (ends.size() > 1) {
    std::vector<Place> merged;
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      const std::size_t last = std::min(i + 1, ends.size() - 1);
      std::inplace_merge(i == 0 ? items.begin() : ends[i - 1], ends[i], ends[last], less);
      merged.push_back(ends[last]);
    }
    ends = std::move(merged);
  }
}

}  // namespace

void fold_sorted(LatticePoints&& positions, PointIds&& ids, TilePoints& tile) {
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

void fold_duplicates(LatticePoints&& positions, PointIds&& ids, TilePoints& tile) {
  PageVector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  sort_runs(order, [&](std::uint32_t a, std::uint32_t b) {
    if (positions[a] != positions[b]) return z_order_less(positions[a], positions[b]);
    return ids[a] < ids[b];
  });
  LatticePoints sorted_positions(positions.size());
  PointIds sorted_ids(ids.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted_positions[i] = positions[order[i]];
    sorted_ids[i] = ids[order[i]];
  }
  LatticePoints().swap(positions);
  PointIds().swap(ids);
  fold_sorted(std::move(sorted_positions), std::move(sorted_ids), tile);
}

}  // namespace arris::tiling
