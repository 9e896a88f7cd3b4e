#include "features/arris/ball_shape.h"

#include <algorithm>

#include "features/numerics/mean_covariance.h"

namespace arris {
namespace {

constexpr std::size_t kAtOnce = simd::kWidestBytes / sizeof(double);
constexpr std::size_t kSums = 10;
constexpr std::size_t kColumns = kSums + 2;

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
      V sums[kSums];
      for (std::size_t i = 0; i < kSums; ++i) sums[i] = simd::load<V>(columns.at[i] + first);
      const V radius = simd::load<V>(columns.at[kSums] + first), spacing = simd::load<V>(columns.at[kSums + 1] + first);
      const Eigenvalues<V> values = eigenvalues_of(mean_covariance(sums).covariance);
      const V n = sums[0], x = sums[1], y = sums[2], z = sums[3];
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
    simd::dispatch_for<Shapes>(count, columns, shapes.data() + first, count);
  }
}

}  // namespace arris
