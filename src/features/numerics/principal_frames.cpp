#include "features/numerics/principal_frames.h"

namespace arris {
namespace {

template <class V>
struct Triple {
  V x, y, z;
};

template <class V>
ARRIS_ALWAYS_INLINE V dot(const Triple<V>& a, const Triple<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
ARRIS_ALWAYS_INLINE Triple<V> cross(const Triple<V>& a, const Triple<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class V, class Mask>
ARRIS_ALWAYS_INLINE Triple<V> select(const Mask& which, const Triple<V>& a, const Triple<V>& b) {
  return {which ? a.x : b.x, which ? a.y : b.y, which ? a.z : b.z};
}
template <class V>
ARRIS_ALWAYS_INLINE Triple<V> product(const SymmetricMatrix<V>& a, const Triple<V>& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}
template <class V>
ARRIS_ALWAYS_INLINE V size_of(const V& v) {
  return v < 0.0 ? -v : v;
}

/// As kernel_vector().
template <class V>
ARRIS_ALWAYS_INLINE Triple<V> kernel_of(const SymmetricMatrix<V>& a, const V& value) {
  const V zero{};
  const Triple<V> r0{a.xx - value, a.xy, a.xz};
  const Triple<V> r1{a.xy, a.yy - value, a.yz};
  const Triple<V> r2{a.xz, a.yz, a.zz - value};
  Triple<V> best = cross(r0, r1);
  V best2 = dot(best, best);
  for (const Triple<V>& other : {cross(r0, r2), cross(r1, r2)}) {
    const V other2 = dot(other, other);
    best = select(other2 > best2, other, best);
    best2 = other2 > best2 ? other2 : best2;
  }
  const V inverse = 1.0 / simd::square_root(best2);
  return select(best2 > 0.0, Triple<V>{best.x * inverse, best.y * inverse, best.z * inverse},
                Triple<V>{zero + 1.0, zero, zero});
}

/// A unit vector at right angles to the unit vector w.
template <class V>
ARRIS_ALWAYS_INLINE Triple<V> perpendicular(const Triple<V>& w) {
  const V zero{};
  const auto leave_y = size_of(w.x) > size_of(w.y);
  const V kept = leave_y ? w.x : w.y;
  const V inverse = 1.0 / simd::square_root(kept * kept + w.z * w.z);
  return select(leave_y, Triple<V>{-w.z * inverse, zero, w.x * inverse},
                Triple<V>{zero, w.z * inverse, -w.y * inverse});
}

}  // namespace

struct PrincipalFrames::Kernel {
  /// The operations of principal_frame(), in its order; what that branches on is selected here.
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(PrincipalFrames& f) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t i = 0; i < kCount; i += Bytes / sizeof(double)) {
      const auto in = [&](std::size_t row) __attribute__((always_inline)) {
        return simd::load<V>(f.in_[row].data() + i);
      };
      const SymmetricMatrix<V> a{in(0), in(1), in(2), in(3), in(4), in(5)};
      const V l1 = in(6), l2 = in(7), l3 = in(8);
      const V zero{};
      const V one = zero + 1.0;
      const auto first_apart = l1 - l2 > l2 - l3;
      const Triple<V> apart = kernel_of(a, first_apart ? l1 : l3);
      const Triple<V> u = perpendicular(apart);
      const Triple<V> v = cross(apart, u);
      const Triple<V> au = product(a, u);
      const V uu = dot(u, au);
      const V uv = dot(v, au);
      const V vv = dot(v, product(a, v));
      const V half = 0.5 * (uu - vv);
      const V radius = simd::square_root(half * half + uv * uv);
      V c = half >= 0.0 ? half + radius : uv;
      V s = half >= 0.0 ? uv : radius - half;
      const V norm = simd::square_root(c * c + s * s);
      c = norm > 0.0 ? c / norm : one;
      s = norm > 0.0 ? s / norm : zero;
      const Triple<V> larger{c * u.x + s * v.x, c * u.y + s * v.y, c * u.z + s * v.z};
      const auto any = l1 > l3;
      const Triple<V> e1 = select(any, select(first_apart, apart, larger), Triple<V>{one, zero, zero});
      const Triple<V> e2 = select(any, select(first_apart, larger, cross(apart, larger)), Triple<V>{zero, one, zero});
      const Triple<V> e3 = select(any, cross(e1, e2), Triple<V>{zero, zero, one});
      std::size_t row = 0;
      for (const Triple<V>& e : {e1, e2, e3}) {
        for (const V& component : {e.x, e.y, e.z}) simd::store(f.out_[row++].data() + i, component);
      }
    }
  }
};

void PrincipalFrames::solve() {
  simd::dispatch<Kernel>(*this);
}

}  // namespace arris
