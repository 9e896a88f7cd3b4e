#pragma once
/// @file Principal frames of one matrix (V = double) or of those in the lanes of vectors: selections for branches, so
/// that both have the same bits.

#include "features/numerics/symmetric_eigen3.h"

namespace arris {

template <class V>
struct VectorOf3 {
  V x, y, z;
};

template <class V>
struct FrameLanes {
  Eigenvalues<V> values;
  VectorOf3<V> e1, e2, e3;
};

namespace detail {

template <class V>
ARRIS_ALWAYS_INLINE V dot(const VectorOf3<V>& a, const VectorOf3<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
ARRIS_ALWAYS_INLINE VectorOf3<V> cross(const VectorOf3<V>& a, const VectorOf3<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class V>
ARRIS_ALWAYS_INLINE VectorOf3<V> product(const SymmetricMatrix<V>& a, const VectorOf3<V>& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}
/// `mask` is what a comparison of V gives.
template <class M, class V>
ARRIS_ALWAYS_INLINE VectorOf3<V> select(const M& mask, const VectorOf3<V>& a, const VectorOf3<V>& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}
/// Unit vectors in the kernels of a - value; the first axis where none of it is determined.
template <class V>
ARRIS_ALWAYS_INLINE VectorOf3<V> kernel_vectors(const SymmetricMatrix<V>& a, const V& value) {
  const VectorOf3<V> r0{a.xx - value, a.xy, a.xz};
  const VectorOf3<V> r1{a.xy, a.yy - value, a.yz};
  const VectorOf3<V> r2{a.xz, a.yz, a.zz - value};
  VectorOf3<V> best = cross(r0, r1);
  V best_norm2 = dot(best, best);
  for (const VectorOf3<V>& candidate : {cross(r0, r2), cross(r1, r2)}) {
    const V norm2 = dot(candidate, candidate);
    best = select(norm2 > best_norm2, candidate, best);
    best_norm2 = norm2 > best_norm2 ? norm2 : best_norm2;
  }
  const V zero{};
  const V inverse = 1.0 / simd::square_root(best_norm2);
  const VectorOf3<V> unit{best.x * inverse, best.y * inverse, best.z * inverse};
  return select(best_norm2 > 0.0, unit, VectorOf3<V>{zero + 1.0, zero, zero});
}

/// Unit vectors at right angles to the unit vectors w.
template <class V>
ARRIS_ALWAYS_INLINE VectorOf3<V> any_perpendiculars(const VectorOf3<V>& w) {
  const V zero{};
  const auto by_x = simd::magnitude(w.x) > simd::magnitude(w.y);
  const V main = by_x ? w.x : w.y;
  const V inverse = 1.0 / simd::square_root(main * main + w.z * w.z);
  return {by_x ? -w.z * inverse : zero, by_x ? zero : w.z * inverse, by_x ? w.x * inverse : -w.y * inverse};
}

}  // namespace detail

/// @param values  eigenvalues_of(a).
template <class V>
ARRIS_ALWAYS_INLINE FrameLanes<V> frame_lanes(const SymmetricMatrix<V>& a, const Eigenvalues<V>& values) {
  using namespace detail;
  FrameLanes<V> frame;
  frame.values = values;
  const auto& [l1, l2, l3] = frame.values;
  const auto first_apart = l1 - l2 > l2 - l3;
  const VectorOf3<V> apart = kernel_vectors(a, first_apart ? l1 : l3);
  const VectorOf3<V> u = any_perpendiculars(apart);
  const VectorOf3<V> v = cross(apart, u);
  const VectorOf3<V> au = product(a, u);
  const V uu = dot(u, au);
  const V uv = dot(v, au);
  const V vv = dot(v, product(a, v));
  const V half = 0.5 * (uu - vv);
  const V radius = simd::square_root(half * half + uv * uv);
  V c = half >= 0.0 ? half + radius : uv;  // (c, s): direction of the larger of the two values in (u, v).
  V s = half >= 0.0 ? uv : radius - half;
  const V norm = simd::square_root(c * c + s * s);
  const V zero{};
  c = norm > 0.0 ? c / norm : zero + 1.0;
  s = norm > 0.0 ? s / norm : zero;
  const VectorOf3<V> larger{c * u.x + s * v.x, c * u.y + s * v.y, c * u.z + s * v.z};
  frame.e1 = select(first_apart, apart, larger);
  frame.e2 = select(first_apart, larger, cross(apart, larger));
  frame.e3 = cross(frame.e1, frame.e2);
  const auto spread = l1 > l3;
  frame.e1 = select(spread, frame.e1, VectorOf3<V>{zero + 1.0, zero, zero});
  frame.e2 = select(spread, frame.e2, VectorOf3<V>{zero, zero + 1.0, zero});
  frame.e3 = select(spread, frame.e3, VectorOf3<V>{zero, zero, zero + 1.0});
  return frame;
}
template <class V>
ARRIS_ALWAYS_INLINE FrameLanes<V> frame_lanes(const SymmetricMatrix<V>& a) {
  return frame_lanes(a, eigenvalues_of(a));
}

}  // namespace arris
