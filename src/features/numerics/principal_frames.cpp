#include "features/numerics/principal_frames.h"

#include "features/numerics/frame_lanes.h"

namespace arris {

struct PrincipalFrames::Kernel {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(PrincipalFrames& f) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t i = 0; i < kCount; i += Bytes / sizeof(double)) {
      V in[kInputs];
      for (std::size_t row = 0; row < kInputs; ++row) in[row] = simd::load<V>(f.in_[row].data() + i);
      const FrameLanes<V> frame =
          frame_lanes<V>({in[0], in[1], in[2], in[3], in[4], in[5]}, Eigenvalues<V>{in[6], in[7], in[8]});
      std::size_t row = 0;
      for (const VectorOf3<V>& e : {frame.e1, frame.e2, frame.e3}) {
        for (const V& component : {e.x, e.y, e.z}) simd::store(f.out_[row++].data() + i, component);
      }
    }
  }
};

void PrincipalFrames::solve() {
  simd::dispatch<Kernel>(*this);
}

}  // namespace arris
