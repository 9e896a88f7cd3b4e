#include "features/supervoxel/least_direction.h"

#include <cstring>

namespace arris {

struct LeastDirections::Kernel {
  template <class V>
  struct Triple {
    V x, y, z;
  };
  template <class V>
  static ARRIS_ALWAYS_INLINE Triple<V> cross(const Triple<V>& a, const Triple<V>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  template <class V>
  static ARRIS_ALWAYS_INLINE V norm2(const Triple<V>& a) {
    return a.x * a.x + a.y * a.y + a.z * a.z;
  }
  /// Where `other` is longer it takes the place of `best`.
  template <class V>
  static ARRIS_ALWAYS_INLINE void keep_longer(Triple<V>& best, V& length2, const Triple<V>& other) {
    const V other2 = norm2(other);
    best.x = other2 > length2 ? other.x : best.x;
    best.y = other2 > length2 ? other.y : best.y;
    best.z = other2 > length2 ? other.z : best.z;
    length2 = other2 > length2 ? other2 : length2;
  }

  template <class V>
  static ARRIS_ALWAYS_INLINE void store(Lanes& to, std::size_t at, const V& from) {
    std::memcpy(to.data() + at, &from, sizeof from);
  }

  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(LeastDirections& d) {
    using V = typename simd::VectorOf<double, Bytes>::Type;
    constexpr std::size_t kLanes = simd::VectorOf<double, Bytes>::kLanes;
    for (std::size_t i = 0; i < kCount; i += kLanes) {
      const SymmetricMatrix<V> a{simd::load<V>(d.xx_.data() + i), simd::load<V>(d.xy_.data() + i),
                                 simd::load<V>(d.xz_.data() + i), simd::load<V>(d.yy_.data() + i),
                                 simd::load<V>(d.yz_.data() + i), simd::load<V>(d.zz_.data() + i)};
      const Eigenvalues<V> values = eigenvalues_of(a);
      // Rows of a - smallest * I; the kernel is at right angles to all.
      const Triple<V> r0{a.xx - values.smallest, a.xy, a.xz};
      const Triple<V> r1{a.xy, a.yy - values.smallest, a.yz};
      const Triple<V> r2{a.xz, a.yz, a.zz - values.smallest};
      Triple<V> best = cross(r0, r1);
      V length2 = norm2(best);
      keep_longer(best, length2, cross(r0, r2));
      keep_longer(best, length2, cross(r1, r2));
      const V inverse = 1.0 / simd::square_root(length2);
      store(d.largest_, i, values.largest);
      store(d.middle_, i, values.middle);
      store(d.smallest_, i, values.smallest);
      store(d.x_, i, best.x * inverse);
      store(d.y_, i, best.y * inverse);
      store(d.z_, i, best.z * inverse);
    }
  }
};

void LeastDirections::solve() {
  simd::dispatch<Kernel>(*this);
}

}  // namespace arris
