#include "features/planar/plane_frame.h"

#include <cmath>

#include "features/neighbourhood/ball_points.h"

namespace arris {
namespace {

Vector3 rounded(const Vector3& a) {
  return {on_grid<kFrameBits>(a[0]), on_grid<kFrameBits>(a[1]), on_grid<kFrameBits>(a[2])};
}

}  // namespace

PlaneFrame plane_frame(const Vector3& normal) {
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::fabs(normal[axis]) < std::fabs(normal[least])) least = axis;
  }
  Vector3 e{0, 0, 0};
  e[least] = 1.0;
  Vector3 u = cross(normal, e);
  const double length = std::sqrt(dot(u, u));
  for (double& c : u) c /= length;
  return {rounded(u), rounded(cross(normal, u)), rounded(normal)};
}

}  // namespace arris
