#include "features/arris/ball_shape.h"

#include <algorithm>

namespace arris {
namespace {

constexpr std::size_t kAtOnce = simd::kWidestBytes / sizeof(double);
constexpr std::size_t kColumns = 12;

/// Balls side by side.
struct Columns {
  double at[kColumns][kAtOnce];
};

struct Shapes {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const Columns& columns, BallShape* shapes, std::size_t count) {
    using V = typename simd::Wide<Bytes>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    for (std::size_t first = 0; first < count; first += kLanes) {
      V c[kColumns];
      for (std::size_t i = 0; i < kColumns; ++i) c[i] = simd::load<V>(columns.at[i] + first);
      const auto& [n, x, y, z, xx, xy, xz, yy, yz, zz, radius, spacing] = c;
      const V inverse = 1.0 / n;
      const V mx = x * inverse, my = y * inverse, mz = z * inverse;
      const SymmetricMatrix<V> covariance{xx * inverse - mx * mx, xy * inverse - mx * my, xz * inverse - mx * mz,
                                          yy * inverse - my * my, yz * inverse - my * mz, zz * inverse - mz * mz};
      const Eigenvalues<V> values = eigenvalues_of(covariance);
      const V rms = simd::square_root(values.smallest > 0.0 ? values.smallest : V{}) / spacing;
      const V middle_rms = simd::square_root(values.middle > 0.0 ? values.middle : V{}) / spacing;
      const V off_centre = simd::square_root(x * x + y * y + z * z) / (n * radius);
      for (std::size_t lane = 0; lane < std::min(kLanes, count - first); ++lane) {
        shapes[first + lane] = {n[lane], rms[lane], middle_rms[lane], off_centre[lane]};
      }
    }
  }
};

}  // namespace

void measure_shapes(std::span<const BallMeasure> balls, std::span<BallShape> shapes) {
  Columns columns;
  for (std::size_t first = 0; first < balls.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, balls.size() - first);
    for (std::size_t lane = 0; lane < kAtOnce; ++lane) {
      const auto& [m, radius, spacing] = balls[first + std::min(lane, count - 1)];  // Lanes that are left repeat one.
      const double row[kColumns] = {m.n, m.x, m.y, m.z, m.xx, m.xy, m.xz, m.yy, m.yz, m.zz, radius, spacing};
      for (std::size_t i = 0; i < kColumns; ++i) columns.at[i][lane] = row[i];
    }
    simd::dispatch<Shapes>(columns, shapes.data() + first, count);
  }
}

}  // namespace arris
