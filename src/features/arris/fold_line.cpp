#include "features/arris/fold_line.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "features/numerics/exact_math.h"
#include "features/numerics/exact_sums.h"
#include "features/numerics/least_squares.h"

namespace arris {
namespace {

constexpr int kRounds = 3;
constexpr double kGateDeviations = 2.5;
constexpr double kLeastGate = 0.3;
constexpr double kLeastArmPoints = 8.0;
/// Squared standard errors that a bend must be away from 0.
constexpr double kBendSignificance = 9.0;
constexpr int kRegressorBits = 5;
constexpr int kOffsetBits = 10;
/// Reach, spacings, of what supports a fold at its foot, and how far behind the line an arm may begin.
constexpr double kSupportReach = 1.6;
constexpr double kSupportBehind = 0.3;
constexpr double kSupportGate = 0.5;
/// Variance of the position at the rim of a half disc, from which the line is extrapolated, in units of sigma² / n:
/// 1 + (centroid 0.424 r / spread 0.264 r)².
constexpr double kRimVariance = 3.6;

/// offset = c + b u + a t + k t².
struct ArmSurface {
  double c = 0.0, b = 0.0, a = 0.0, k = 0.0;

  template <class V>
  ARRIS_ALWAYS_INLINE V at(const V& u, const V& t) const {
    return c + b * u + (a + k * t) * t;
  }
};

/// Sums for the least squares of one arm over the regressors 1, u, t, t².
struct ArmSums {
  double n = 0, u = 0, t = 0, t2 = 0, uu = 0, ut = 0, ut2 = 0, t3 = 0, t4 = 0, w = 0, wu = 0, wt = 0, wt2 = 0, ww = 0;
  bool operator==(const ArmSums&) const = default;
};

/// The frame of both arms: origin at the point of the line that is nearest to the centre, `t` along the line, `away`
/// from it within the arm, `normal` on the side of the other arm.
struct ArmFrame {
  Vector3 origin, t;
  Vector3 away[2], normal[2];
};

struct SumArms {
  template <class V>
  struct Sums {
    V v[14]{};
  };

  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, const ArmFrame& f, const ArmSurface* surfaces, double gate,
                                      ArmSums* out) {
    using V = typename simd::Wide<Bytes>::Double;
    Sums<V> sums[2];
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V px = simd::load<V>(p.x.data() + i);
      const V real = simd::where_above(V{} + BallPoints::kPaddingCoordinate, px);
      const V x = real * px - f.origin[0];
      const V y = real * simd::load<V>(p.y.data() + i) - f.origin[1];
      const V z = real * simd::load<V>(p.z.data() + i) - f.origin[2];
      const V t = on_grid<kRegressorBits>(f.t[0] * x + f.t[1] * y + f.t[2] * z);
      V u[2], w[2], off[2];
      ARRIS_UNROLL
      for (int k = 0; k < 2; ++k) {
        u[k] = on_grid<kRegressorBits>(f.away[k][0] * x + f.away[k][1] * y + f.away[k][2] * z);
        w[k] = on_grid<kOffsetBits>(f.normal[k][0] * x + f.normal[k][1] * y + f.normal[k][2] * z);
        off[k] = w[k] - surfaces[k].at(u[k], t);
      }
      const V in_a = real * simd::where_above(off[1], off[0]);
      V near[2];
      ARRIS_UNROLL
      for (int k = 0; k < 2; ++k) {
        near[k] = simd::where_at_most(off[k] * off[k], gate * gate);
      }
      add(in_a * near[0], t, u[0], w[0], sums[0]);
      add((real - in_a) * near[1], t, u[1], w[1], sums[1]);
    }
    for (int k = 0; k < 2; ++k) out[k] = std::bit_cast<ArmSums>(simd::exact_lane_sums(sums[k].v));
  }

  /// `weight` is 0 or 1.
  template <class V>
  static ARRIS_ALWAYS_INLINE void add(const V& weight, V t, V u, V w, Sums<V>& s) {
    t *= weight;
    u *= weight;
    w *= weight;
    const V t2 = t * t;
    s.v[0] += weight;
    s.v[1] += u;
    s.v[2] += t;
    s.v[3] += t2;
    s.v[9] += w;
    const V factors[][2] = {{u, u}, {u, t}, {u, t2}, {t2, t}, {t2, t2}};
    ARRIS_UNROLL
    for (int k = 0; k < 5; ++k) s.v[4 + k] = simd::exact_multiply_add(factors[k][0], factors[k][1], s.v[4 + k]);
    const V beside_w[] = {u, t, t2, w};
    ARRIS_UNROLL
    for (int k = 0; k < 4; ++k) s.v[10 + k] = simd::exact_multiply_add(w, beside_w[k], s.v[10 + k]);
  }
};

/// Fits one arm; returns the sum of its squared residuals, or a negative number if it cannot be fitted.
double fit_arm(const ArmSums& s, ArmSurface& surface) {
  const double m[4][4] = {{s.n, 0, 0, 0}, {s.u, s.uu, 0, 0}, {s.t, s.ut, s.t2, 0}, {s.t2, s.ut2, s.t3, s.t4}};
  const double y[4] = {s.w, s.wu, s.wt, s.wt2};
  const auto residuals = [&](const double(&x)[4], int size) {
    double sum = s.ww;
    for (int i = 0; i < size; ++i) sum -= x[i] * y[i];
    return std::max(sum, 0.0);
  };
  const CholeskyFactor<4> factor(m);
  if (factor.independent() < 3) return -1.0;
  double flat[4] = {};
  factor.solve(y, 3, flat);
  surface = {flat[0], flat[1], flat[2], 0.0};
  if (factor.independent() == 4) {
    double bent[4] = {};
    factor.solve(y, 4, bent);
    const double left = residuals(bent, 4);
    const double noise2 = std::max(left / std::max(s.n - 4.0, 1.0), 1e-9);
    if (bent[3] * bent[3] > kBendSignificance * noise2 * factor.last_variance(4)) {
      surface = {bent[0], bent[1], bent[2], bent[3]};
      return left;
    }
  }
  return residuals(flat, 3);
}

bool make_frame(const PlanePair& pair, ArmFrame& frame) {
  const Vector3 e = cross(pair.a.normal, pair.b.normal);
  const double sine2 = dot(e, e);
  if (sine2 < 1e-8) return false;
  const double sine = std::sqrt(sine2);
  const Vector3 u = cross(pair.b.normal, e);
  const Vector3 v = cross(e, pair.a.normal);
  for (int axis = 0; axis < 3; ++axis) {
    frame.t[axis] = e[axis] / sine;
    frame.origin[axis] = (pair.a.offset * u[axis] + pair.b.offset * v[axis]) / sine2;
  }
  const FittedPlane* planes[2] = {&pair.a, &pair.b};
  for (int k = 0; k < 2; ++k) {
    frame.normal[k] = planes[k]->normal;
    frame.away[k] = cross(planes[k]->normal, frame.t);
    Vector3 to_centroid;
    for (int axis = 0; axis < 3; ++axis) to_centroid[axis] = planes[k]->centroid[axis] - frame.origin[axis];
    if (dot(frame.away[k], to_centroid) < 0.0) {
      for (double& c : frame.away[k]) c = -c;
    }
  }
  for (int k = 0; k < 2; ++k) {
    if (dot(frame.normal[k], frame.away[1 - k]) < 0.0) {
      for (double& c : frame.normal[k]) c = -c;
    }
  }
  return true;
}

/// Where the surfaces meet in the cross-section through the origin (t = 0); false if they do not.
/// @param sine2  squared sine of the angle between the arms there.
bool intersect(const ArmFrame& f, const ArmSurface* surfaces, FoldLine& line, double& sine2) {
  double height[2];
  Vector3 gradient[2];
  for (int k = 0; k < 2; ++k) {
    height[k] = surfaces[k].c;
    for (int axis = 0; axis < 3; ++axis) {
      gradient[k][axis] = f.normal[k][axis] - surfaces[k].b * f.away[k][axis];
    }
  }
  const double m00 = dot(gradient[0], f.normal[0]), m01 = dot(gradient[0], f.away[0]);
  const double m10 = dot(gradient[1], f.normal[0]), m11 = dot(gradient[1], f.away[0]);
  const double determinant = m00 * m11 - m01 * m10;
  if (std::fabs(determinant) < 1e-6) return false;
  const double x = (height[0] * m11 - height[1] * m01) / determinant;
  const double y = (m00 * height[1] - m10 * height[0]) / determinant;
  Vector3 arm[2];
  for (int axis = 0; axis < 3; ++axis) {
    line.foot[axis] = f.origin[axis] + x * f.normal[0][axis] + y * f.away[0][axis];
    for (int k = 0; k < 2; ++k) arm[k][axis] = f.away[k][axis] + surfaces[k].b * f.normal[k][axis];
  }
  for (Vector3& a : arm) {
    const double length = std::sqrt(dot(a, a));
    for (double& c : a) c /= length;
  }
  line.distance = std::sqrt(dot(line.foot, line.foot));
  const double cosine = dot(arm[0], arm[1]);
  sine2 = std::max(1.0 - cosine * cosine, 0.0);
  line.sine2_half = 0.5 * (1.0 - cosine);
  line.angle_deg = arc_cosine(cosine) * kDegreesPerRadian;
  for (int axis = 0; axis < 3; ++axis) line.opening[axis] = arm[0][axis] + arm[1][axis];
  const double length = std::sqrt(dot(line.opening, line.opening));
  for (double& c : line.opening) c = length > 0.0 ? c / length : 0.0;
  line.direction = f.t;
  return true;
}

/// Members beside the foot, within the gate of the arm that is nearer.
struct CountSupport {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, const ArmFrame& f, const ArmSurface* surfaces, double gate,
                                      FoldLine& line) {
    using V = typename simd::Wide<Bytes>::Double;
    V counts[2]{};
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V px = simd::load<V>(p.x.data() + i);
      const V real = simd::where_above(V{} + BallPoints::kPaddingCoordinate, px);
      const V x = px - line.foot[0];
      const V y = simd::load<V>(p.y.data() + i) - line.foot[1];
      const V z = simd::load<V>(p.z.data() + i) - line.foot[2];
      const V t = simd::magnitude(f.t[0] * x + f.t[1] * y + f.t[2] * z);
      V off[2], beside[2];
      ARRIS_UNROLL
      for (int k = 0; k < 2; ++k) {
        const V u = f.away[k][0] * x + f.away[k][1] * y + f.away[k][2] * z;
        off[k] = simd::magnitude(f.normal[k][0] * x + f.normal[k][1] * y + f.normal[k][2] * z - surfaces[k].b * u);
        beside[k] = simd::where_at_most(off[k], gate) * simd::where_at_most(V{} - kSupportBehind, u) *
                    simd::where_at_most(u, kSupportReach);
      }
      const V near = real * simd::where_at_most(t, kSupportReach);
      const V of_a = simd::where_at_most(off[0], off[1]);
      counts[0] += near * of_a * beside[0];
      counts[1] += near * (1.0 - of_a) * beside[1];
    }
    line.support_a = static_cast<int>(simd::exact_lane_sum(counts[0]));
    line.support_b = static_cast<int>(simd::exact_lane_sum(counts[1]));
  }
};

}  // namespace

bool refine_fold(const BallPoints& points, const PlanePair& pair, FoldLine& line) {
  ArmFrame frame;
  if (!make_frame(pair, frame)) return false;
  ArmSurface surfaces[2];
  const double gate = std::max(kGateDeviations * pair.rms, kLeastGate);
  double squares = 0.0;
  ArmSums before[2];
  for (int round = 0; round < kRounds; ++round) {
    ArmSums sums[2];
    simd::dispatch<SumArms>(points, frame, surfaces, gate, sums);
    // The same sums give the same surfaces, in this round and in all that follow.
    if (round > 0 && sums[0] == before[0] && sums[1] == before[1]) break;
    std::copy(std::begin(sums), std::end(sums), before);
    squares = 0.0;
    for (int k = 0; k < 2; ++k) {
      if (sums[k].n < kLeastArmPoints) return false;
      const double left = fit_arm(sums[k], surfaces[k]);
      if (left < 0.0) return false;
      squares += left;
    }
    line.count_a = sums[0].n;
    line.count_b = sums[1].n;
  }
  line.rms = std::sqrt(squares / (line.count_a + line.count_b));
  double sine2 = 0.0;
  if (!intersect(frame, surfaces, line, sine2)) return false;
  // The line moves by the arms' errors over the sine of the angle at which they cross.
  const double variance = kRimVariance * line.rms * line.rms * (1.0 / line.count_a + 1.0 / line.count_b);
  line.position_error = std::sqrt(variance / std::max(sine2, 0.01));
  simd::dispatch<CountSupport>(points, frame, surfaces, std::max(kGateDeviations * line.rms, kSupportGate), line);
  return true;
}

}  // namespace arris
