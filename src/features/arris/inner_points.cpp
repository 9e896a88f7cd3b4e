#include "features/arris/inner_points.h"

#include <algorithm>
#include <cmath>

#include "features/numerics/simd.h"

namespace arris {
namespace {

/// Fewer points are sorted as quickly.
constexpr std::size_t kLeastPoints = 24;
/// Of the square of the largest coordinate. A point that much inside of an edge (area) is inside in spite of rounding.
constexpr double kMargin = 1e-9;

constexpr std::size_t kDirections = 8;

/// The coordinates along the first four of eight directions 45 degrees apart; those along the others are their
/// negatives. No need for unit vectors.
template <class V>
ARRIS_ALWAYS_INLINE void coordinates_along(const V& x, const V& y, V (&along)[kDirections / 2]) {
  along[0] = x;
  along[1] = x + y;
  along[2] = y;
  along[3] = y - x;
}

struct Supports {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const double* x, const double* y, std::size_t n,
                                      double (&supports)[kDirections]) {
    using V = typename simd::Wide<Bytes>::Double;
    V most[kDirections / 2], least[kDirections / 2];
    coordinates_along(simd::load<V>(x), simd::load<V>(y), most);
    std::copy_n(most, kDirections / 2, least);
    for (std::size_t i = Bytes / sizeof(double); i < n; i += Bytes / sizeof(double)) {
      V along[kDirections / 2];
      coordinates_along(simd::load<V>(x + i), simd::load<V>(y + i), along);
      for (std::size_t k = 0; k < kDirections / 2; ++k) {
        most[k] = along[k] > most[k] ? along[k] : most[k];
        least[k] = along[k] < least[k] ? along[k] : least[k];
      }
    }
    for (std::size_t k = 0; k < kDirections / 2; ++k) {
      supports[k] = greatest(most[k]);
      supports[k + kDirections / 2] = greatest(-least[k]);
    }
  }

 private:
  template <class V>
  static ARRIS_ALWAYS_INLINE double greatest(const V& v) {
    if constexpr (sizeof(V) > 16) {
      typename simd::Wide<sizeof(V) / 2>::Double halves[2];
      std::memcpy(halves, &v, sizeof(V));
      return greatest(halves[0] > halves[1] ? halves[0] : halves[1]);
    } else {
      return std::max(v[0], v[1]);
    }
  }
};

/// Marks the points that are outermost in a direction.
struct MarkOutermost {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const double* x, const double* y, std::size_t n,
                                      const double (&supports)[kDirections], std::int64_t* marks) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t i = 0; i < n; i += Bytes / sizeof(double)) {
      V along[kDirections / 2];
      coordinates_along(simd::load<V>(x + i), simd::load<V>(y + i), along);
      typename simd::Wide<Bytes>::Long marked{};
      for (std::size_t k = 0; k < kDirections / 2; ++k) {
        marked |= simd::bits(simd::ones<V>(along[k] == supports[k]));
        marked |= simd::bits(simd::ones<V>(along[k] == -supports[k + kDirections / 2]));
      }
      simd::store(marks + i, marked);
    }
  }
};

/// To the left of an edge, by more than rounding: a x + b y > c.
struct Edge {
  double a, b, c;
};

struct MarkInner {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const double* x, const double* y, std::size_t n, const Edge (&edges)[kDirections],
                                      std::int64_t* marks) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t i = 0; i < n; i += Bytes / sizeof(double)) {
      const V px = simd::load<V>(x + i), py = simd::load<V>(y + i);
      auto inside = ~typename simd::Wide<Bytes>::Long{};
      for (const Edge& e : edges) inside &= simd::bits(simd::where_above(px * e.a + py * e.b, e.c));
      simd::store(marks + i, inside);
    }
  }
};

/// The outermost point in each direction.
void find_corners(const std::vector<Planar>& points, const InnerScratch& s, const double (&supports)[kDirections],
                  Planar (&corners)[kDirections]) {
  bool known[kDirections] = {};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (s.marks[i] == 0) continue;
    double along[kDirections / 2];
    coordinates_along(points[i].first, points[i].second, along);
    for (std::size_t k = 0; k < kDirections; ++k) {
      const double here = k < kDirections / 2 ? along[k] : -along[k - kDirections / 2];
      if (here != supports[k] || (known[k] && corners[k] <= points[i])) continue;
      corners[k] = points[i];
      known[k] = true;
    }
  }
}

}  // namespace

void drop_inner_points(std::vector<Planar>& points, InnerScratch& s) {
  const std::size_t n = points.size();
  if (n < kLeastPoints) return;
  const std::size_t padded = simd::padded(n);
  s.x.resize(padded);
  s.y.resize(padded);
  s.marks.resize(padded);
  for (std::size_t i = 0; i < padded; ++i) {
    const Planar& p = points[i < n ? i : 0];
    s.x[i] = p.first;
    s.y[i] = p.second;
  }
  const double* const x = s.x.data();
  const double* const y = s.y.data();
  double supports[kDirections];
  simd::dispatch<Supports>(x, y, padded, supports);
  simd::dispatch<MarkOutermost>(x, y, padded, supports, s.marks.data());
  Planar corners[kDirections];
  find_corners(points, s, supports, corners);
  const double largest = *std::max_element(std::begin(supports), std::end(supports));
  Edge edges[kDirections];
  int sides = 0;
  for (std::size_t k = 0; k < kDirections; ++k) {
    const Planar& from = corners[k];
    const Planar& to = corners[(k + 1) % kDirections];
    const double a = from.second - to.second;
    const double b = to.first - from.first;
    const bool side = a != 0.0 || b != 0.0;  // Else everything is to its left.
    edges[k] = {a, b, side ? a * from.first + b * from.second + kMargin * largest * largest : -1.0};
    sides += side;
  }
  if (sides < 3) return;
  simd::dispatch<MarkInner>(x, y, padded, edges, s.marks.data());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    points[kept] = points[i];
    kept += s.marks[i] == 0;
  }
  points.resize(kept);
}

}  // namespace arris
