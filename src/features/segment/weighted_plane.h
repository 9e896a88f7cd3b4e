#pragma once
/// @file Least-squares plane of weighted points, one neighbourhood per lane.

#include "features/numerics/symmetric_eigen3.h"
#include "features/segment/neighbourhood_batch.h"

namespace arris::detail {

template <class V>
struct LanePlane {
  V nx, ny, nz;  ///< Unit normal.
  V px, py, pz;  ///< A point on the plane.
  V variation, width;

  ARRIS_ALWAYS_INLINE V distance(const V& x, const V& y, const V& z) const {
    return nx * (x - px) + ny * (y - py) + nz * (z - pz);
  }
};

/// Unit vector in the kernel of a - value, as kernel_vector() gives it.
template <class V>
ARRIS_ALWAYS_INLINE void lane_kernel(const SymmetricMatrix<V>& a, const V& value, LanePlane<V>& plane) {
  const V dx = a.xx - value, dy = a.yy - value, dz = a.zz - value;
  const V ax = a.xy * a.yz - a.xz * dy, ay = a.xz * a.xy - dx * a.yz, az = dx * dy - a.xy * a.xy;
  const V bx = a.xy * dz - a.xz * a.yz, by = a.xz * a.xz - dx * dz, bz = dx * a.yz - a.xy * a.xz;
  const V cx = dy * dz - a.yz * a.yz, cy = a.yz * a.xz - a.xy * dz, cz = a.xy * a.yz - dy * a.xz;
  V x = ax, y = ay, z = az, norm2 = ax * ax + ay * ay + az * az;
  const V norm2_b = bx * bx + by * by + bz * bz;
  x = norm2_b > norm2 ? bx : x;
  y = norm2_b > norm2 ? by : y;
  z = norm2_b > norm2 ? bz : z;
  norm2 = norm2_b > norm2 ? norm2_b : norm2;
  const V norm2_c = cx * cx + cy * cy + cz * cz;
  x = norm2_c > norm2 ? cx : x;
  y = norm2_c > norm2 ? cy : y;
  z = norm2_c > norm2 ? cz : z;
  norm2 = norm2_c > norm2 ? norm2_c : norm2;
  const V zero = x - x;
  const V one = zero + 1.0;
  const V inverse = one / simd::square_root(norm2 > 0.0 ? norm2 : one);
  plane.nx = norm2 > 0.0 ? x * inverse : one;
  plane.ny = norm2 > 0.0 ? y * inverse : zero;
  plane.nz = norm2 > 0.0 ? z * inverse : zero;
}

/// @param weight(i)  of neighbour i; `query_weight` of the query itself. The sum of the weights must be positive.
/// Two passes: the mean first, so that no digits are lost in neighbourhoods far off the query.
template <class V, class Weight>
ARRIS_ALWAYS_INLINE LanePlane<V> weighted_plane(const NeighbourhoodBatch& batch, std::size_t lane,
                                                const V& query_weight, const Weight& weight) {
  const V zero = query_weight - query_weight;
  V n = query_weight, mx = zero, my = zero, mz = zero;
  for (std::size_t i = 0; i < batch.neighbours; ++i) {
    const V w = weight(i);
    n += w;
    mx += w * simd::load<V>(batch.x[i].data() + lane);
    my += w * simd::load<V>(batch.y[i].data() + lane);
    mz += w * simd::load<V>(batch.z[i].data() + lane);
  }
  const V inverse = 1.0 / n;
  LanePlane<V> plane;
  plane.px = mx * inverse;
  plane.py = my * inverse;
  plane.pz = mz * inverse;
  SymmetricMatrix<V> a;
  a.xx = query_weight * plane.px * plane.px;
  a.xy = query_weight * plane.px * plane.py;
  a.xz = query_weight * plane.px * plane.pz;
  a.yy = query_weight * plane.py * plane.py;
  a.yz = query_weight * plane.py * plane.pz;
  a.zz = query_weight * plane.pz * plane.pz;
  for (std::size_t i = 0; i < batch.neighbours; ++i) {
    const V w = weight(i);
    const V x = simd::load<V>(batch.x[i].data() + lane) - plane.px;
    const V y = simd::load<V>(batch.y[i].data() + lane) - plane.py;
    const V z = simd::load<V>(batch.z[i].data() + lane) - plane.pz;
    const V wx = w * x, wy = w * y;
    a.xx += wx * x;
    a.xy += wx * y;
    a.xz += wx * z;
    a.yy += wy * y;
    a.yz += wy * z;
    a.zz += w * z * z;
  }
  const Eigenvalues<V> values = eigenvalues_of(a);
  lane_kernel(a, values.smallest, plane);
  const V smallest = values.smallest > 0.0 ? values.smallest : zero;
  const V middle = values.middle > 0.0 ? values.middle : zero;
  const V total = smallest + middle + values.largest;
  plane.variation = total > 0.0 ? smallest / total : zero;
  plane.width = values.largest > 0.0 ? middle / values.largest : zero;
  return plane;
}

}  // namespace arris::detail
