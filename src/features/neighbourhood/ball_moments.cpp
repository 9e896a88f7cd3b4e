#include "features/neighbourhood/ball_moments.h"

#include <cmath>
#include <limits>

namespace arris {
namespace {

/// What sums are made of: products of floats below 2^24 are exact, their sums need more bits than floats have.
template <class T, int Bytes>
struct SumsOf {
  using Type = typename simd::VectorOf<T, Bytes>::Type;
  static ARRIS_ALWAYS_INLINE Type of(const Type& v) { return v; }
};
template <int Bytes>
struct SumsOf<float, Bytes> {
  using Type = typename simd::VectorOf<float, Bytes>::Mask;
  static ARRIS_ALWAYS_INLINE Type of(const typename simd::VectorOf<float, Bytes>::Type& v) {
    return __builtin_convertvector(v, Type);
  }
};

/// Sums of products in a lane are exact below this: floats are added up as 32-bit integers.
template <class T>
constexpr double kExactProductSums = kExactSquares<T>;
template <>
inline constexpr double kExactProductSums<float> = 2147483648.0;  // 2^31

struct SumMembers {
  template <int Bytes, class T>
  static ARRIS_ALWAYS_INLINE void run(const CandidateSet<T>& c, const BallQuery<T>& ball, BallMoments& out) {
    using V = typename simd::VectorOf<T, Bytes>::Type;
    using Mask = typename simd::VectorOf<T, Bytes>::Mask;
    using S = SumsOf<T, Bytes>;
    Mask n{};
    V x{}, y{}, z{};
    typename S::Type xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    const std::size_t end = simd::padded(c.count);
    for (std::size_t i = 0; i < end; i += simd::VectorOf<T, Bytes>::kLanes) {
      V dx = simd::load<V>(c.x.data() + i) - ball.x;
      V dy = simd::load<V>(c.y.data() + i) - ball.y;
      V dz = simd::load<V>(c.z.data() + i) - ball.z;
      const auto inside = (dx * dx + dy * dy + dz * dz) <= ball.radius2;
      dx = inside ? dx : V{};  // Others add zeros.
      dy = inside ? dy : V{};
      dz = inside ? dz : V{};
      n -= inside;
      x += dx;
      y += dy;
      z += dz;
      xx += S::of(dx * dx);
      xy += S::of(dx * dy);
      xz += S::of(dx * dz);
      yy += S::of(dy * dy);
      yz += S::of(dy * dz);
      zz += S::of(dz * dz);
    }
    using simd::exact_lane_sum;
    out = {exact_lane_sum(n),  exact_lane_sum(x),  exact_lane_sum(y),  exact_lane_sum(z),  exact_lane_sum(xx),
           exact_lane_sum(xy), exact_lane_sum(xz), exact_lane_sum(yy), exact_lane_sum(yz), exact_lane_sum(zz)};
  }
};

/// The least and the greatest coordinate along a direction.
template <class V>
struct Range {
  V least{};  // The centre itself is a member, at 0.
  V most{};

  ARRIS_ALWAYS_INLINE void add(const V& v) {
    least = v < least ? v : least;
    most = v > most ? v : most;
  }
  ARRIS_ALWAYS_INLINE double extent() const {
    double low = 0.0;
    double high = 0.0;
    for (std::size_t lane = 0; lane < sizeof(V) / sizeof(least[0]); ++lane) {
      low = std::min(low, static_cast<double>(least[lane]));
      high = std::max(high, static_cast<double>(most[lane]));
    }
    return high - low;
  }
};

struct Extents {
  template <int Bytes, class T>
  static ARRIS_ALWAYS_INLINE void run(const CandidateSet<T>& c, const BallQuery<T>& ball, const Vector3& e,
                                      const Vector3& f, double (&extents)[2]) {
    using V = typename simd::VectorOf<T, Bytes>::Type;
    const T ex = static_cast<T>(e[0]), ey = static_cast<T>(e[1]), ez = static_cast<T>(e[2]);
    const T fx = static_cast<T>(f[0]), fy = static_cast<T>(f[1]), fz = static_cast<T>(f[2]);
    Range<V> along_e, along_f;
    const std::size_t end = simd::padded(c.count);
    for (std::size_t i = 0; i < end; i += simd::VectorOf<T, Bytes>::kLanes) {
      const V dx = simd::load<V>(c.x.data() + i) - ball.x;
      const V dy = simd::load<V>(c.y.data() + i) - ball.y;
      const V dz = simd::load<V>(c.z.data() + i) - ball.z;
      const auto inside = (dx * dx + dy * dy + dz * dz) <= ball.radius2;
      along_e.add(inside ? dx * ex + dy * ey + dz * ez : V{});
      along_f.add(inside ? dx * fx + dy * fy + dz * fz : V{});
    }
    extents[0] = along_e.extent();
    extents[1] = along_f.extent();
  }
};

void sum(const CandidateSet<float>& c, const BallQuery<float>& b, BallMoments& out) {
  simd::dispatch<SumMembers>(c, b, out);
}
void sum(const CandidateSet<double>& c, const BallQuery<double>& b, BallMoments& out) {
  simd::dispatch<SumMembers>(c, b, out);
}

/// Exact whatever the sizes: 2^32 points at 2^30 steps need 94 bits.
void sum(const CandidateSet<std::int64_t>& c, const BallQuery<std::int64_t>& ball, BallMoments& out) {
  __extension__ typedef __int128 Wide;
  Wide s[10] = {};
  for (std::size_t i = 0; i < c.count; ++i) {
    const std::int64_t dx = bounded(c.x[i] - ball.x);
    const std::int64_t dy = bounded(c.y[i] - ball.y);
    const std::int64_t dz = bounded(c.z[i] - ball.z);
    if (dx * dx + dy * dy + dz * dz > ball.radius2) continue;
    const std::int64_t terms[10] = {1, dx, dy, dz, dx * dx, dx * dy, dx * dz, dy * dy, dy * dz, dz * dz};
    for (int t = 0; t < 10; ++t) s[t] += terms[t];
  }
  double d[10];
  for (int t = 0; t < 10; ++t) d[t] = static_cast<double>(s[t]);
  out = {d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7], d[8], d[9]};
}

}  // namespace

SymmetricMatrix<double> BallMoments::covariance() const {
  const double inverse = 1.0 / n;
  const double mx = x * inverse;
  const double my = y * inverse;
  const double mz = z * inverse;
  return {xx * inverse - mx * mx, xy * inverse - mx * my, xz * inverse - mx * mz,
          yy * inverse - my * my, yz * inverse - my * mz, zz * inverse - mz * mz};
}

template <class T>
bool ball_sums_are_exact(double radius, std::size_t count) {
  if constexpr (std::is_same_v<T, std::int64_t>) {
    return true;
  } else {
    // Every lane adds up at most one term per vector of candidates; whatever the width, so that the narrowest decides.
    const double terms = static_cast<double>(count / simd::VectorOf<T, 16>::kLanes + 1);
    const double square = radius * radius;
    return square < kExactSquares<T> && terms * radius < kExactSquares<T> && terms * square < kExactProductSums<T>;
  }
}

template <class T>
BallMoments ball_moments(const CandidateSet<T>& candidates, const BallQuery<T>& ball) {
  BallMoments moments;
  sum(candidates, ball, moments);
  return moments;
}

template <class T>
std::array<ExtentBounds, 2> extent_bounds(const CandidateSet<T>& candidates, const BallQuery<T>& ball, const Vector3& e,
                                          const Vector3& f) {
  const double radius = std::sqrt(static_cast<double>(ball.radius2));
  if constexpr (std::is_same_v<T, std::int64_t>) {
    return {{{0.0, 2.0 * radius}, {0.0, 2.0 * radius}}};  // The slow path does without this rejection.
  } else {
    double extents[2];
    simd::dispatch<Extents>(candidates, ball, e, f, extents);
    // The dot product of three terms in T is off by less than 4 epsilon r at each end.
    const double margin = 16.0 * static_cast<double>(std::numeric_limits<T>::epsilon()) * radius;
    const auto bounds = [margin](double extent) {
      return ExtentBounds{std::max(extent - margin, 0.0), extent + margin};
    };
    return {bounds(extents[0]), bounds(extents[1])};
  }
}

template <class T>
std::size_t ball_members(const CandidateSet<T>& c, const BallQuery<T>& ball, std::vector<std::uint32_t>& members) {
  if (members.size() < c.count) members.resize(c.count);
  std::size_t n = 0;
  for (std::size_t i = 0; i < c.count; ++i) {
    const T dx = bounded<T>(c.x[i] - ball.x);
    const T dy = bounded<T>(c.y[i] - ball.y);
    const T dz = bounded<T>(c.z[i] - ball.z);
    members[n] = static_cast<std::uint32_t>(i);
    n += dx * dx + dy * dy + dz * dz <= ball.radius2;
  }
  return n;
}

template bool ball_sums_are_exact<float>(double, std::size_t);
template bool ball_sums_are_exact<double>(double, std::size_t);
template bool ball_sums_are_exact<std::int64_t>(double, std::size_t);
template BallMoments ball_moments(const CandidateSet<float>&, const BallQuery<float>&);
template BallMoments ball_moments(const CandidateSet<double>&, const BallQuery<double>&);
template BallMoments ball_moments(const CandidateSet<std::int64_t>&, const BallQuery<std::int64_t>&);
template std::array<ExtentBounds, 2> extent_bounds(const CandidateSet<float>&, const BallQuery<float>&, const Vector3&,
                                                   const Vector3&);
template std::array<ExtentBounds, 2> extent_bounds(const CandidateSet<double>&, const BallQuery<double>&,
                                                   const Vector3&, const Vector3&);
template std::array<ExtentBounds, 2> extent_bounds(const CandidateSet<std::int64_t>&, const BallQuery<std::int64_t>&,
                                                   const Vector3&, const Vector3&);
template std::size_t ball_members(const CandidateSet<float>&, const BallQuery<float>&, std::vector<std::uint32_t>&);
template std::size_t ball_members(const CandidateSet<double>&, const BallQuery<double>&, std::vector<std::uint32_t>&);
template std::size_t ball_members(const CandidateSet<std::int64_t>&, const BallQuery<std::int64_t>&,
                                  std::vector<std::uint32_t>&);

}  // namespace arris
