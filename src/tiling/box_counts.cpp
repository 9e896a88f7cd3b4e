#include "tiling/box_counts.h"

#include <algorithm>

#include "tiling/morton.h"

namespace arris::tiling {
namespace {

std::vector<PlanCell> sorted(std::vector<PlanCell> cells) {
  std::ranges::sort(cells, [](const PlanCell& a, const PlanCell& b) { return z_order_less(a.corner, b.corner); });
  return cells;
}

bool inside(const LatticeBox& inner, const LatticeBox& outer) {
  for (int axis = 0; axis < 3; ++axis) {
    if (inner.min[axis] < outer.min[axis] || inner.max[axis] > outer.max[axis]) return false;
  }
  return true;
}

}  // namespace

LatticeBox PlanCell::box() const {
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = corner[axis];
    box.max[axis] = box.min[axis] + (std::int64_t{1} << level);
  }
  return box;
}

BoxCounts::BoxCounts(std::vector<PlanCell> cells)
    : cells_(sorted(std::move(cells))), tree_((cells_.size() + kBucket - 1) / kBucket, [&](std::size_t bucket) {
        LatticeBox box;
        for (std::size_t i = bucket * kBucket; i < std::min(cells_.size(), (bucket + 1) * kBucket); ++i) {
          box.include(cells_[i].box());
        }
        return box;
      }) {
  before_.push_back(0);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (i % kBucket == 0) before_.push_back(before_.back());
    before_.back() += cells_[i].count;
  }
}

std::uint64_t BoxCounts::touching(const LatticeBox& box) const {
  std::uint64_t sum = 0;
  tree_.walk([&](const LatticeBox& bounds, std::size_t begin, std::size_t end) {
    if (!bounds.intersects(box)) return false;
    if (inside(bounds, box)) {
      sum += before_[end] - before_[begin];
      return false;
    }
    if (end - begin == 1) {
      for (std::size_t i = begin * kBucket; i < std::min(cells_.size(), end * kBucket); ++i) {
        if (cells_[i].box().intersects(box)) sum += cells_[i].count;
      }
    }
    return true;
  });
  return sum;
}

}  // namespace arris::tiling
