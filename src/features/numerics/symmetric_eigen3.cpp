#include "features/numerics/symmetric_eigen3.h"

#include <cmath>

namespace arris {
namespace {

Vector3 scaled(const Vector3& v, double by) {
  return {v[0] * by, v[1] * by, v[2] * by};
}

/// A unit vector at right angles to the unit vector w.
Vector3 any_perpendicular(const Vector3& w) {
  if (std::fabs(w[0]) > std::fabs(w[1])) {
    const double inverse = 1.0 / std::sqrt(w[0] * w[0] + w[2] * w[2]);
    return {-w[2] * inverse, 0.0, w[0] * inverse};
  }
  const double inverse = 1.0 / std::sqrt(w[1] * w[1] + w[2] * w[2]);
  return {0.0, w[2] * inverse, -w[1] * inverse};
}

Vector3 product(const SymmetricMatrix<double>& a, const Vector3& v) {
  return {a.xx * v[0] + a.xy * v[1] + a.xz * v[2], a.xy * v[0] + a.yy * v[1] + a.yz * v[2],
          a.xz * v[0] + a.yz * v[1] + a.zz * v[2]};
}

}  // namespace

Vector3 kernel_vector(const SymmetricMatrix<double>& a, double value) {
  const Vector3 r0{a.xx - value, a.xy, a.xz};
  const Vector3 r1{a.xy, a.yy - value, a.yz};
  const Vector3 r2{a.xz, a.yz, a.zz - value};
  const Vector3 candidates[3] = {cross(r0, r1), cross(r0, r2), cross(r1, r2)};
  Vector3 best = candidates[0];
  double best_norm2 = dot(best, best);
  for (int i = 1; i < 3; ++i) {
    const double norm2 = dot(candidates[i], candidates[i]);
    if (norm2 > best_norm2) {
      best_norm2 = norm2;
      best = candidates[i];
    }
  }
  if (!(best_norm2 > 0.0)) return {1.0, 0.0, 0.0};
  return scaled(best, 1.0 / std::sqrt(best_norm2));
}

PrincipalFrame principal_frame(const SymmetricMatrix<double>& a, const Eigenvalues<double>& values) {
  PrincipalFrame frame;
  frame.values = values;
  const auto& [l1, l2, l3] = frame.values;
  if (!(l1 > l3)) {
    frame.e1 = {1.0, 0.0, 0.0};
    frame.e2 = {0.0, 1.0, 0.0};
    frame.e3 = {0.0, 0.0, 1.0};
    return frame;
  }
  const bool first_apart = l1 - l2 > l2 - l3;
  const Vector3 apart = kernel_vector(a, first_apart ? l1 : l3);
  const Vector3 u = any_perpendicular(apart);
  const Vector3 v = cross(apart, u);
  const Vector3 au = product(a, u);
  const double uu = dot(u, au);
  const double uv = dot(v, au);
  const double vv = dot(v, product(a, v));
  const double half = 0.5 * (uu - vv);
  const double radius = std::sqrt(half * half + uv * uv);
  double c = half >= 0.0 ? half + radius : uv;  // (c, s): direction of the larger of the two values in (u, v).
  double s = half >= 0.0 ? uv : radius - half;
  const double norm = std::sqrt(c * c + s * s);
  if (norm > 0.0) {
    c /= norm;
    s /= norm;
  } else {
    c = 1.0;
    s = 0.0;
  }
  const Vector3 larger{c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2]};
  if (first_apart) {
    frame.e1 = apart;
    frame.e2 = larger;
  } else {
    frame.e1 = larger;
    frame.e2 = cross(apart, larger);
  }
  frame.e3 = cross(frame.e1, frame.e2);
  return frame;
}

}  // namespace arris
