#include "features/liu/entropy_scale.h"

#include <algorithm>
#include <limits>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

constexpr std::size_t kLanes = 8;

/// First and second moments of a growing set, relative to the query. Exact while k * distance² < 2^53; beyond, the
/// canonical order of the neighbours makes the rounding the same everywhere.
struct RunningMoments {
  double x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  ARRIS_ALWAYS_INLINE void add(double dx, double dy, double dz) {
    x += dx;
    y += dy;
    z += dz;
    xx += dx * dx;
    xy += dx * dy;
    xz += dx * dz;
    yy += dy * dy;
    yz += dy * dz;
    zz += dz * dz;
  }
};

/// The sums over the first `count` neighbours (a multiple of eight), which must be exact: lanes change their order.
struct SumFirst {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const Neighbours& neighbours, std::size_t count, RunningMoments& m) {
    using V = typename simd::Wide<Bytes>::Double;
    V x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    for (std::size_t i = 0; i < count; i += Bytes / sizeof(double)) {
      const auto dx = simd::load<V>(neighbours.dx.data() + i);
      const auto dy = simd::load<V>(neighbours.dy.data() + i);
      const auto dz = simd::load<V>(neighbours.dz.data() + i);
      x += dx;
      y += dy;
      z += dz;
      xx += dx * dx;
      xy += dx * dy;
      xz += dx * dz;
      yy += dy * dy;
      yz += dy * dz;
      zz += dz * dz;
    }
    m = {simd::lane_sum(x),  simd::lane_sum(y),  simd::lane_sum(z),  simd::lane_sum(xx), simd::lane_sum(xy),
         simd::lane_sum(xz), simd::lane_sum(yy), simd::lane_sum(yz), simd::lane_sum(zz)};
  }
};

/// Starts the sums with as many of the first k_min neighbours as whole vectors hold; returns how many.
int start_moments(const Neighbours& neighbours, int k_min, RunningMoments& moments) {
  constexpr double kExactSums = 9007199254740992.0;  // 2^53
  if (neighbours.d2[static_cast<std::size_t>(k_min - 1)] * k_min >= kExactSums) return 0;
  const int count = k_min / 8 * 8;
  simd::dispatch<SumFirst>(neighbours, static_cast<std::size_t>(count), moments);
  return count;
}

template <class V>
ARRIS_ALWAYS_INLINE V entropy_term(const V& a) {
  const V positive = a > 1e-300 ? a : a - a + 1e-300;  // 0 ln 0 = 0.
  return a * log_of_positive(positive);
}

template <class V>
ARRIS_ALWAYS_INLINE V entropy_of(const Eigenvalues<V>& values) {
  const V zero = values.largest - values.largest;
  const V l1 = values.largest > 0.0 ? values.largest : zero + 1.0;
  const V d1 = simd::square_root(l1);
  const V d2 = simd::square_root(values.middle > 0.0 ? values.middle : zero);
  const V d3 = simd::square_root(values.smallest > 0.0 ? values.smallest : zero);
  const V inverse = 1.0 / d1;
  const V a1 = (d1 - d2) * inverse;
  const V a2 = (d2 - d3) * inverse;
  const V a3 = d3 * inverse;
  const V entropy = -(entropy_term(a1) + entropy_term(a2) + entropy_term(a3));
  return values.largest > 0.0 ? entropy : zero + std::numeric_limits<double>::infinity();
}

struct Batch {
  std::size_t used = 0;  ///< Lanes that mean something; the others only have to be finite.
  double size[kLanes];
  double x[kLanes], y[kLanes], z[kLanes];
  double xx[kLanes], xy[kLanes], xz[kLanes], yy[kLanes], yz[kLanes], zz[kLanes];

  void set(std::size_t lane, const RunningMoments& m, double n) {
    size[lane] = n;
    x[lane] = m.x;
    y[lane] = m.y;
    z[lane] = m.z;
    xx[lane] = m.xx;
    xy[lane] = m.xy;
    xz[lane] = m.xz;
    yy[lane] = m.yy;
    yz[lane] = m.yz;
    zz[lane] = m.zz;
  }
};

struct Evaluation {
  double xx[kLanes], xy[kLanes], xz[kLanes], yy[kLanes], yz[kLanes], zz[kLanes];  ///< n² times the covariance.
  double largest[kLanes], middle[kLanes], smallest[kLanes];
  double entropy[kLanes];

  ScaleChoice choice(std::size_t lane, int k) const {
    return {
        k, {xx[lane], xy[lane], xz[lane], yy[lane], yz[lane], zz[lane]}, {largest[lane], middle[lane], smallest[lane]}};
  }
};

struct Evaluate {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const Batch& b, Evaluation& out) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t i = 0; i < b.used; i += Bytes / sizeof(double)) {
      const auto n = simd::load<V>(b.size + i);
      const auto x = simd::load<V>(b.x + i);
      const auto y = simd::load<V>(b.y + i);
      const auto z = simd::load<V>(b.z + i);
      SymmetricMatrix<V> c;
      c.xx = n * simd::load<V>(b.xx + i) - x * x;
      c.xy = n * simd::load<V>(b.xy + i) - x * y;
      c.xz = n * simd::load<V>(b.xz + i) - x * z;
      c.yy = n * simd::load<V>(b.yy + i) - y * y;
      c.yz = n * simd::load<V>(b.yz + i) - y * z;
      c.zz = n * simd::load<V>(b.zz + i) - z * z;
      const Eigenvalues<V> values = eigenvalues_of(c);
      simd::store(out.xx + i, c.xx);
      simd::store(out.xy + i, c.xy);
      simd::store(out.xz + i, c.xz);
      simd::store(out.yy + i, c.yy);
      simd::store(out.yz + i, c.yz);
      simd::store(out.zz + i, c.zz);
      simd::store(out.largest + i, values.largest);
      simd::store(out.middle + i, values.middle);
      simd::store(out.smallest + i, values.smallest);
      simd::store(out.entropy + i, entropy_of(values));
    }
  }
};

/// The running minimum over ascending k.
struct Best {
  double entropy = std::numeric_limits<double>::infinity();
  std::size_t lane = 0;
  int k = 0;

  void offer(double e, std::size_t at, int size) {
    if (!(e < entropy - kEntropyTie)) return;
    entropy = e;
    lane = at;
    k = size;
  }
};

}  // namespace

template <class V>
V dimensional_entropy(const Eigenvalues<V>& values) {
  return entropy_of(values);
}
template double dimensional_entropy(const Eigenvalues<double>&);

ScaleChoice choose_scale(const Neighbours& neighbours, const ScaleRange& range) {
  const int last = std::min(range.k_max, static_cast<int>(neighbours.count));
  Best planar;
  Best any;
  ScaleChoice planar_choice;
  ScaleChoice any_choice;
  RunningMoments moments;
  if (last < range.k_min) return {};
  int added = start_moments(neighbours, range.k_min, moments);
  for (int k = range.k_min; k <= last;) {
    Batch batch;
    int sizes[kLanes];
    std::size_t lanes = 0;
    for (; lanes < kLanes && k <= last; ++lanes, k += range.k_step) {
      for (; added < k; ++added) moments.add(neighbours.dx[added], neighbours.dy[added], neighbours.dz[added]);
      batch.set(lanes, moments, k + (range.with_target ? 1 : 0));
      sizes[lanes] = k;
    }
    for (std::size_t lane = lanes; lane < kLanes; ++lane) batch.set(lane, moments, k);
    Evaluation evaluation;
    batch.used = lanes;
    simd::dispatch<Evaluate>(batch, evaluation);
    const int planar_before = planar.k;
    const int any_before = any.k;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      any.offer(evaluation.entropy[lane], lane, sizes[lane]);
      if (evaluation.middle[lane] >= range.min_planarity * evaluation.largest[lane]) {
        planar.offer(evaluation.entropy[lane], lane, sizes[lane]);
      }
    }
    if (planar.k != planar_before) planar_choice = evaluation.choice(planar.lane, planar.k);
    if (any.k != any_before) any_choice = evaluation.choice(any.lane, any.k);
  }
  return planar.k > 0 ? planar_choice : any_choice;
}

}  // namespace arris
