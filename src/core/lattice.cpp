#include "core/lattice.h"

#include <cmath>

namespace arris {

void LatticeBox::include(const LatticePoint& p) {
  include(LatticeBox{{p.x, p.y, p.z}, {std::int64_t{p.x} + 1, std::int64_t{p.y} + 1, std::int64_t{p.z} + 1}});
}

void LatticeBox::include(const LatticeBox& box) {
  if (box.empty()) return;
  if (empty()) {
    *this = box;
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    min[axis] = std::min(min[axis], box.min[axis]);
    max[axis] = std::max(max[axis], box.max[axis]);
  }
}

LatticeBox LatticeBox::unlimited_beyond(const LatticeBox& bounds) const {
  constexpr std::int64_t kUnlimited = std::int64_t{1} << 40;
  LatticeBox box = *this;
  for (int axis = 0; axis < 3; ++axis) {
    if (box.min[axis] <= bounds.min[axis]) box.min[axis] = -kUnlimited;
    if (box.max[axis] >= bounds.max[axis]) box.max[axis] = kUnlimited;
  }
  return box;
}

std::int64_t LatticeBox::depth(const LatticePoint& p) const {
  if (!contains(p)) return 0;
  std::int64_t depth = max[0] - p.x;
  for (int axis = 0; axis < 3; ++axis) {
    depth = std::min({depth, p[axis] - min[axis] + 1, max[axis] - p[axis]});
  }
  return depth;
}

std::int64_t Lattice::index(int axis, double world) const {
  const double steps = (world - origin[axis]) / step;
  constexpr double kLimit = 9.0e18;  // Beyond int64: clamp, the caller rejects it as out of range.
  if (steps >= kLimit) return static_cast<std::int64_t>(kLimit);
  if (steps <= -kLimit) return static_cast<std::int64_t>(-kLimit);
  return std::llround(steps);
}

}  // namespace arris
