#include "features/neighbourhood/ball_moments.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

#include "features/neighbourhood/product_sums.h"
#include "features/numerics/exact_sums.h"
#include "features/numerics/mean_covariance.h"

namespace arris {
namespace {

/// Adding up in T is worth it if the sums need to go on in double after this many vectors of candidates, or more.
constexpr double kLeastRow = 8.0;

/// Adds up in vectors of Sum, which is T or double.
template <class Sum>
struct SumMembers {
  template <int Bytes, class T>
  static ARRIS_ALWAYS_INLINE void run(const CandidateSet<T>& c, const BallQuery<T>& ball, std::size_t vectors_in_row,
                                      BallMoments& out) {
    constexpr std::size_t kLanes = simd::VectorOf<Sum, Bytes>::kLanes;
    typename simd::Wide<Bytes>::Double totals[10]{};
    const std::size_t end = simd::padded(c.count);
    for (std::size_t begin = 0; begin < end;) {
      const std::size_t stop = std::min(end - begin, vectors_in_row * kLanes) + begin;
      add_row<Bytes>(c, ball, begin, stop, totals);
      begin = stop;
    }
    out = std::bit_cast<BallMoments>(simd::exact_lane_sums(totals));
  }

 private:
  template <int Bytes, class T>
  static ARRIS_ALWAYS_INLINE void add_row(const CandidateSet<T>& c, const BallQuery<T>& ball, std::size_t begin,
                                          std::size_t end, typename simd::Wide<Bytes>::Double (&totals)[10]) {
    using V = typename simd::VectorOf<Sum, Bytes>::Type;
    constexpr std::size_t kLanes = simd::VectorOf<Sum, Bytes>::kLanes;
    typedef T Loaded __attribute__((vector_size(kLanes * sizeof(T))));
    const Sum centre[3] = {ball.x, ball.y, ball.z};
    const Sum radius2 = ball.radius2;
    V n{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    for (std::size_t i = begin; i < end; i += kLanes) {
      V dx = __builtin_convertvector(simd::load<Loaded>(c.x.data() + i), V) - centre[0];
      V dy = __builtin_convertvector(simd::load<Loaded>(c.y.data() + i), V) - centre[1];
      V dz = __builtin_convertvector(simd::load<Loaded>(c.z.data() + i), V) - centre[2];
      const auto inside = (dx * dx + dy * dy + dz * dz) <= radius2;
      dx = inside ? dx : V{};  // Others add zeros.
      dy = inside ? dy : V{};
      dz = inside ? dz : V{};
      n += inside ? V{} + Sum{1} : V{};
      x += dx;
      y += dy;
      z += dz;
      xx = simd::exact_multiply_add(dx, dx, xx);
      xy = simd::exact_multiply_add(dx, dy, xy);
      xz = simd::exact_multiply_add(dx, dz, xz);
      yy = simd::exact_multiply_add(dy, dy, yy);
      yz = simd::exact_multiply_add(dy, dz, yz);
      zz = simd::exact_multiply_add(dz, dz, zz);
    }
    const V* const sums[] = {&n, &x, &y, &z, &xx, &xy, &xz, &yy, &yz, &zz};
    for (int i = 0; i < 10; ++i) totals[i] += simd::exact_doubles(*sums[i]);
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

template <class T>
void sum(const CandidateSet<T>& c, const BallQuery<T>& b, BallMoments& out) {
  if constexpr (std::is_same_v<T, float>) {
    if (c.products.exact) {
      out = add_products(c, b);
      return;
    }
  }
  // A lane adds up one square of at most radius2 per vector.
  const double largest = std::max(static_cast<double>(b.radius2), 1.0);
  if (kLeastRow * largest <= kExactSquares<T>) {
    simd::dispatch<SumMembers<T>>(c, b, static_cast<std::size_t>(kExactSquares<T> / largest), out);
  } else {
    simd::dispatch<SumMembers<double>>(c, b, static_cast<std::size_t>(kExactSquares<double> / largest), out);
  }
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
  return mean_covariance({n, x, y, z, xx, xy, xz, yy, yz, zz}).covariance;
}

template <class T>
bool ball_sums_are_exact(double radius) {
  return std::is_same_v<T, std::int64_t> || kLeastRow * radius * radius < kExactSquares<double>;
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

template bool ball_sums_are_exact<float>(double);
template bool ball_sums_are_exact<double>(double);
template bool ball_sums_are_exact<std::int64_t>(double);
template BallMoments ball_moments(const CandidateSet<float>&, const BallQuery<float>&);
template BallMoments ball_moments(const CandidateSet<double>&, const BallQuery<double>&);
template BallMoments ball_moments(const CandidateSet<std::int64_t>&, const BallQuery<std::int64_t>&);
template std::array<ExtentBounds, 2> extent_bounds(const CandidateSet<float>&, const BallQuery<float>&, const Vector3&,
                                                   const Vector3&);
template std::array<ExtentBounds, 2> extent_bounds(const CandidateSet<double>&, const BallQuery<double>&,
                                                   const Vector3&, const Vector3&);
template std::array<ExtentBounds, 2> extent_bounds(const CandidateSet<std::int64_t>&, const BallQuery<std::int64_t>&,
                                                   const Vector3&, const Vector3&);

}  // namespace arris
