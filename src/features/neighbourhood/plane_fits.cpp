#include "features/neighbourhood/plane_fits.h"

#include <algorithm>

#include "features/numerics/frame_lanes.h"
#include "features/numerics/mean_covariance.h"

namespace arris {
namespace {

constexpr std::size_t kAtOnce = simd::kWidestBytes / sizeof(double);
constexpr std::size_t kSums = 10;
constexpr std::size_t kResults = 15;

/// Sets of points side by side, and their planes.
struct Columns {
  double sums[kSums][kAtOnce];
  double planes[kResults][kAtOnce];
};

struct Fits {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(Columns& columns, std::size_t count) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t lane = 0; lane < count; lane += Bytes / sizeof(double)) {
      V sums[kSums];
      for (std::size_t i = 0; i < kSums; ++i) sums[i] = simd::load<V>(columns.sums[i] + lane);
      const MeanCovariance<V> m = mean_covariance(sums);
      const FrameLanes<V> f = frame_lanes(m.covariance);
      const V zero{};
      const V results[kResults] = {f.e3.x,
                                   f.e3.y,
                                   f.e3.z,
                                   f.e3.x * m.x + f.e3.y * m.y + f.e3.z * m.z,
                                   m.x,
                                   m.y,
                                   m.z,
                                   f.e1.x,
                                   f.e1.y,
                                   f.e1.z,
                                   f.e2.x,
                                   f.e2.y,
                                   f.e2.z,
                                   simd::square_root(f.values.smallest > 0.0 ? f.values.smallest : zero),
                                   simd::square_root(f.values.middle > 0.0 ? f.values.middle : zero)};
      for (std::size_t i = 0; i < kResults; ++i) simd::store(columns.planes[i] + lane, results[i]);
    }
  }
};

}  // namespace

void fit_planes(std::span<const PointSums> sums, std::span<FittedPlane> planes) {
  Columns columns;
  for (std::size_t first = 0; first < sums.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, sums.size() - first);
    for (std::size_t lane = 0; lane < kAtOnce; ++lane) {
      const PointSums& s = sums[first + std::min(lane, count - 1)];  // Lanes that are left repeat one.
      const double row[kSums] = {s.n, s.x, s.y, s.z, s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
      for (std::size_t i = 0; i < kSums; ++i) columns.sums[i][lane] = row[i];
    }
    simd::dispatch_for<Fits>(count, columns, count);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto& p = columns.planes;
      planes[first + lane] = {{p[0][lane], p[1][lane], p[2][lane]},
                              p[3][lane],
                              {p[4][lane], p[5][lane], p[6][lane]},
                              {p[7][lane], p[8][lane], p[9][lane]},
                              {p[10][lane], p[11][lane], p[12][lane]},
                              p[13][lane],
                              p[14][lane],
                              sums[first + lane].n};
    }
  }
}

}  // namespace arris
