#include "features/neighbourhood/plane_fit.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "features/numerics/exact_sums.h"
#include "features/numerics/mean_covariance.h"

namespace arris {
namespace {

/// Distances are rounded to multiples of 2^-12 spacings before they are squared and added up.
constexpr int kDistanceBits = 12;

template <class V>
struct Sums {
  V n{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};

  /// `weight` is 0 or 1: a product is cheaper than a selection, and as exact.
  ARRIS_ALWAYS_INLINE void add(const V& weight, const V& px, const V& py, const V& pz) {
    const V wx = weight * px;
    const V wy = weight * py;
    const V wz = weight * pz;
    n += weight;
    x += wx;
    y += wy;
    z += wz;
    xx = simd::exact_multiply_add(wx, px, xx);
    xy = simd::exact_multiply_add(wx, py, xy);
    xz = simd::exact_multiply_add(wx, pz, xz);
    yy = simd::exact_multiply_add(wy, py, yy);
    yz = simd::exact_multiply_add(wy, pz, yz);
    zz = simd::exact_multiply_add(wz, pz, zz);
  }
  ARRIS_ALWAYS_INLINE PointSums total() const {
    const V sums[] = {n, x, y, z, xx, xy, xz, yy, yz, zz};
    return std::bit_cast<PointSums>(simd::exact_lane_sums(sums));
  }
};

template <class V>
ARRIS_ALWAYS_INLINE V along(const Vector3& e, const V& x, const V& y, const V& z) {
  return e[0] * x + e[1] * y + e[2] * z;
}

/// 1 for points, 0 for padding.
template <class V>
ARRIS_ALWAYS_INLINE V real_points(const V& x) {
  return simd::where_above(V{} + BallPoints::kPaddingCoordinate, x);
}

template <class V>
ARRIS_ALWAYS_INLINE V square(const V& v) {
  return v * v;
}

struct Within {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, double radius2, PointSums& out) {
    using V = typename simd::Wide<Bytes>::Double;
    Sums<V> sums;
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      sums.add(simd::where_at_most(x * x + y * y + z * z, radius2), x, y, z);
    }
    out = sums.total();
  }
};

struct NearPlane {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, double radius2, const FittedPlane& plane, double gate,
                                      PointSums& out) {
    using V = typename simd::Wide<Bytes>::Double;
    Sums<V> sums;
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      const V off2 = square(along(plane.normal, x, y, z) - plane.offset);
      sums.add(simd::where_at_most(x * x + y * y + z * z, radius2) * simd::where_at_most(off2, gate * gate), x, y, z);
    }
    out = sums.total();
  }
};

struct CountNearPlane {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, double radius2, const FittedPlane& plane, double gate,
                                      double& out) {
    using V = typename simd::Wide<Bytes>::Double;
    V n{};
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      const V off2 = square(along(plane.normal, x, y, z) - plane.offset);
      n += simd::where_at_most(x * x + y * y + z * z, radius2) * simd::where_at_most(off2, gate * gate);
    }
    out = simd::exact_lane_sum(n);
  }
};

struct All {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, PointSums& out) {
    using V = typename simd::Wide<Bytes>::Double;
    Sums<V> sums;
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      sums.add(real_points<V>(x), x, y, z);
    }
    out = sums.total();
  }
};

struct Side {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, const Split& split, PointSums& out) {
    using V = typename simd::Wide<Bytes>::Double;
    Sums<V> sums;
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      sums.add(real_points<V>(x) * simd::where_above(along(split.g, x, y, z), split.h), x, y, z);
    }
    out = sums.total();
  }
};

struct SplitGated {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, const Split& split, const FittedPlane& plane_a,
                                      const FittedPlane& plane_b, double gate, SplitSums& out) {
    using V = typename simd::Wide<Bytes>::Double;
    Sums<V> a, b;
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      const V real = real_points<V>(x);
      const V in_a = real * simd::where_above(along(split.g, x, y, z), split.h);
      const V off_a = along(plane_a.normal, x, y, z) - plane_a.offset;
      const V off_b = along(plane_b.normal, x, y, z) - plane_b.offset;
      a.add(in_a * simd::where_at_most(square(off_a), gate * gate), x, y, z);
      b.add((real - in_a) * simd::where_at_most(square(off_b), gate * gate), x, y, z);
    }
    out = {a.total(), b.total()};
  }
};

struct CutSquares {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, const Split& split, const FittedPlane& plane_a,
                                      const FittedPlane& plane_b, double most, double& out) {
    using V = typename simd::Wide<Bytes>::Double;
    V sum{};
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      const V in_a = simd::where_above(along(split.g, x, y, z), split.h);
      const V off_a = along(plane_a.normal, x, y, z) - plane_a.offset;
      const V off_b = along(plane_b.normal, x, y, z) - plane_b.offset;
      V off2 = square(on_grid<kDistanceBits>(in_a * off_a + (1.0 - in_a) * off_b));
      const V cut = simd::where_above(off2, most * most);
      off2 = (1.0 - cut) * off2 + cut * (most * most);
      sum += real_points<V>(x) * off2;
    }
    out = simd::exact_lane_sum(sum);
  }
};

}  // namespace

FittedPlane fit_plane(const PointSums& s) {
  const MeanCovariance<double> m = mean_covariance({s.n, s.x, s.y, s.z, s.xx, s.xy, s.xz, s.yy, s.yz, s.zz});
  const PrincipalFrame frame = principal_frame(m.covariance);
  FittedPlane plane;
  plane.normal = frame.e3;
  plane.centroid = {m.x, m.y, m.z};
  plane.offset = dot(plane.normal, plane.centroid);
  plane.e1 = frame.e1;
  plane.e2 = frame.e2;
  plane.rms = std::sqrt(std::max(frame.values.smallest, 0.0));
  plane.middle_rms = std::sqrt(std::max(frame.values.middle, 0.0));
  plane.count = s.n;
  return plane;
}

PointSums sum_within(const BallPoints& points, double radius) {
  PointSums sums;
  simd::dispatch<Within>(points, radius * radius, sums);
  return sums;
}

PointSums sum_near_plane(const BallPoints& points, double radius, const FittedPlane& plane, double gate) {
  PointSums sums;
  simd::dispatch<NearPlane>(points, radius * radius, plane, gate, sums);
  return sums;
}

double count_near_plane(const BallPoints& points, double radius, const FittedPlane& plane, double gate) {
  double count = 0.0;
  simd::dispatch<CountNearPlane>(points, radius * radius, plane, gate, count);
  return count;
}

PointSums sum_all(const BallPoints& points) {
  PointSums sums;
  simd::dispatch<All>(points, sums);
  return sums;
}

PointSums sum_side(const BallPoints& points, const Split& split) {
  PointSums sums;
  simd::dispatch<Side>(points, split, sums);
  return sums;
}

SplitSums sum_split(const BallPoints& points, const Split& split, const FittedPlane& a, const FittedPlane& b,
                    double gate) {
  SplitSums sums;
  simd::dispatch<SplitGated>(points, split, a, b, gate, sums);
  return sums;
}

double mean_cut_square(const BallPoints& points, const Split& split, const FittedPlane& a, const FittedPlane& b,
                       double most) {
  double sum = 0.0;
  simd::dispatch<CutSquares>(points, split, a, b, most, sum);
  return sum / static_cast<double>(points.count);
}

}  // namespace arris
