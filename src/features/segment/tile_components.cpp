#include "features/segment/tile_components.h"

#include <algorithm>
#include <numeric>

namespace arris {

TileComponents::TileComponents(const PointTree& tree, const TileNeighbourhoods& points, const QueryRings& queries,
                               TileLinks& links)
    : tree_(tree), points_(points), queries_(queries), links_(links), component_(tree.size(), 0) {
  for (std::uint32_t slot = 0; slot < tree_.size(); ++slot) {
    if (!links.numbered(slot)) continue;
    const std::uint32_t root = links.root(slot);  // The smallest of the set: numbered first, if it is numbered.
    if (component_[root] == 0) {
      sizes_.push_back(0);
      component_[root] = static_cast<std::uint32_t>(sizes_.size());
    }
    component_[slot] = component_[root];
    sizes_[component_[slot] - 1] += queries.is_query(slot);
  }
}

void TileComponents::measure(TileGrowth& growth) {
  growth.sizes = sizes_;
  growth.discs.assign(sizes_.size(), 0);
  for (std::uint32_t slot = 0; slot < tree_.size(); ++slot) {
    if (component_[slot] == 0) continue;
    const std::uint32_t disc = disc_of(slot);
    if (queries_.is_query(slot)) {
      growth.discs[component_[slot] - 1] += disc;
    } else {
      growth.touched.push_back({tree_.id(slot), component_[slot], disc});
    }
  }
}

void TileComponents::list(TileGrowth& growth) const {
  growth.members.reserve(std::accumulate(sizes_.begin(), sizes_.end(), std::size_t{0}));
  queries_.for_each_query([&](std::uint32_t slot) {
    if (component_[slot] != 0) growth.members.push_back({static_cast<std::uint32_t>(tree_.id(slot)), component_[slot]});
  });
}

std::uint32_t TileComponents::disc_of(std::uint32_t slot) const {
  const std::size_t count = points_.count(slot);
  if (count == 0) return 0;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(points_.squared_reach(slot) / count, 0xffffffffU));
}

bool TileComponents::all_around(std::uint32_t slot, std::uint32_t least) const {
  const std::uint32_t component = component_[slot];
  if (component == 0 || sizes_[component - 1] < least) return false;
  if (links_.among_own(slot)) return true;
  for (const std::uint32_t neighbour : points_.neighbours(slot))
    if (component_[neighbour] != component) return false;
  return true;
}

}  // namespace arris
