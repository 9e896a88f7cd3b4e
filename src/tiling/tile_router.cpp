#include "tiling/tile_router.h"

#include <algorithm>

namespace arris::tiling {
namespace {

constexpr LatticeBox kEverywhere{{-(std::int64_t{1} << 40), -(std::int64_t{1} << 40), -(std::int64_t{1} << 40)},
                                 {std::int64_t{1} << 40, std::int64_t{1} << 40, std::int64_t{1} << 40}};

/// Cuts `region`, which holds p, so that it no longer meets `box`, which does not: at the side of the box farthest from
/// p.
void exclude(LatticeBox& region, const LatticeBox& box, const LatticePoint& p) {
  std::int64_t farthest = -1;
  int cut_axis = 0;
  bool above = false;  // Region ends where the box begins.
  for (int axis = 0; axis < 3; ++axis) {
    if (const std::int64_t gap = box.min[axis] - p[axis]; gap > 0 && gap > farthest) {
      farthest = gap;
      cut_axis = axis;
      above = true;
    }
    if (const std::int64_t gap = p[axis] - box.max[axis] + 1; gap > 0 && gap > farthest) {
      farthest = gap;
      cut_axis = axis;
      above = false;
    }
  }
  if (above) {
    region.max[cut_axis] = std::min(region.max[cut_axis], box.min[cut_axis]);
  } else {
    region.min[cut_axis] = std::max(region.min[cut_axis], box.max[cut_axis]);
  }
}

void intersect(LatticeBox& region, const LatticeBox& box) {
  for (int axis = 0; axis < 3; ++axis) {
    region.min[axis] = std::max(region.min[axis], box.min[axis]);
    region.max[axis] = std::min(region.max[axis], box.max[axis]);
  }
}

}  // namespace

TileRouter::TileRouter(const TilePlan& plan)
    : tree_(plan.tiles.size(), [&](std::size_t tile) { return plan.tiles[tile].covered; }) {}

void TileRouter::look_up(const LatticePoint& p, Route& route) const {
  route.region = kEverywhere;
  route.tiles.clear();
  tree_.walk([&](const LatticeBox& box, std::size_t begin, std::size_t end) {
    if (!box.contains(p)) {
      if (!box.empty()) exclude(route.region, box, p);
      return false;
    }
    if (end - begin == 1) {
      intersect(route.region, box);
      route.tiles.push_back(static_cast<std::uint32_t>(begin));
    }
    return true;
  });
}

const TileRouter::Route& TileRouter::route(const LatticePoint& p) {
  if (recent_[current_].region.contains(p)) return recent_[current_];
  for (std::size_t i = 0; i < recent_.size(); ++i) {
    if (recent_[i].region.contains(p)) {
      current_ = i;
      return recent_[i];
    }
  }
  current_ = oldest_;
  oldest_ = (oldest_ + 1) % recent_.size();
  look_up(p, recent_[current_]);
  return recent_[current_];
}

void TileRouter::touching(const LatticeBox& box, std::vector<std::uint32_t>& tiles) const {
  tree_.walk([&](const LatticeBox& bounds, std::size_t begin, std::size_t end) {
    if (!bounds.intersects(box)) return false;
    if (end - begin == 1) tiles.push_back(static_cast<std::uint32_t>(begin));
    return true;
  });
}

}  // namespace arris::tiling
