#include "features/liu/fold_screen.h"

#include "features/numerics/mean_covariance.h"

namespace arris {

struct FoldScreen::Kernel {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(FoldScreen& s) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t i = 0; i < kCount; i += Bytes / sizeof(double)) {
      const auto in = [&](std::size_t row) __attribute__((always_inline)) {
        return simd::load<V>(s.in_[row].data() + i);
      };
      V sums[10];
      for (std::size_t row = 0; row < 10; ++row) sums[row] = in(row);
      const SymmetricMatrix<V> c = mean_covariance(sums).covariance;
      const Eigenvalues<V> values = eigenvalues_of(c);
      const V bound = chord_deviation_bound(values, sums[0], in(10));
      std::size_t row = 0;
      for (const V& out : {c.xx, c.xy, c.xz, c.yy, c.yz, c.zz, values.largest, values.middle, values.smallest, bound}) {
        simd::store(s.out_[row++].data() + i, out);
      }
    }
  }
};

void FoldScreen::solve() {
  simd::dispatch<Kernel>(*this);
}

}  // namespace arris
