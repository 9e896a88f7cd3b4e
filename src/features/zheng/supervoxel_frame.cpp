#include "features/zheng/supervoxel_frame.h"

#include <cmath>

#include "features/neighbourhood/ball_points.h"

namespace arris {
namespace {

constexpr int kFrameBits = 18;

Vector3 rounded(const Vector3& a) {
  return {on_grid<kFrameBits>(a[0]), on_grid<kFrameBits>(a[1]), on_grid<kFrameBits>(a[2])};
}

}  // namespace

SupervoxelFrame supervoxel_frame(const SupervoxelTable& table, std::uint32_t label) {
  const Vector3 n{table.normal[label][0], table.normal[label][1], table.normal[label][2]};
  SupervoxelFrame frame;
  if (dot(n, n) < 0.5) return frame;
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::fabs(n[axis]) < std::fabs(n[least])) least = axis;
  }
  Vector3 e{0, 0, 0};
  e[least] = 1.0;
  Vector3 u = cross(n, e);
  const double length = std::sqrt(dot(u, u));
  for (double& c : u) c /= length;
  frame.u = rounded(u);
  frame.v = rounded(cross(n, u));
  frame.n = rounded(n);
  frame.defined = true;
  return frame;
}

}  // namespace arris
