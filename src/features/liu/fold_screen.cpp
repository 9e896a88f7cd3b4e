#include "features/liu/fold_screen.h"

namespace arris {

struct FoldScreen::Kernel {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(FoldScreen& s) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t i = 0; i < kCount; i += Bytes / sizeof(double)) {
      const auto in = [&](std::size_t row) __attribute__((always_inline)) {
        return simd::load<V>(s.in_[row].data() + i);
      };
      const V n = in(0);
      const V inverse = 1.0 / n;
      const V mx = in(1) * inverse;
      const V my = in(2) * inverse;
      const V mz = in(3) * inverse;
      const SymmetricMatrix<V> c{in(4) * inverse - mx * mx, in(5) * inverse - mx * my, in(6) * inverse - mx * mz,
                                 in(7) * inverse - my * my, in(8) * inverse - my * mz, in(9) * inverse - mz * mz};
      const Eigenvalues<V> values = eigenvalues_of(c);
      const V bound = chord_deviation_bound(values, n, in(10));
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
