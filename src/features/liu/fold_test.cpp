#include "features/liu/fold_test.h"

#include <algorithm>
#include <cmath>

#include "features/numerics/exact_math.h"
#include "features/numerics/fixed_point.h"

namespace arris {
namespace {

/// Computed coordinates and distances are off by less than this share of the radius, by far.
constexpr double kEndMargin = 1e-9;

struct Chord {
  double x, y;    ///< One end.
  double sx, sy;  ///< Unit direction.
};

/// Unsigned, rounded distances of all members; returns their exact sum, and counts the members strictly on either side.
struct Sides {
  double sum = 0;
  std::size_t left = 0;
  std::size_t right = 0;
};

/// Arrays are padded to full vectors with points on the chord, which add nothing.
struct Measure {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(FoldScratch& s, std::size_t n, const Chord& chord, double magic, double on_line,
                                      Sides& sides) {
    using V = typename simd::Wide<Bytes>::Double;
    using Mask = typename simd::Wide<Bytes>::Long;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    V sum{};
    Mask left{};
    Mask right{};
    for (std::size_t i = 0; i < n; i += kLanes) {
      const V du = simd::load<V>(s.u.data() + i) - chord.x;
      const V dv = simd::load<V>(s.v.data() + i) - chord.y;
      const V signed_distance = chord.sx * dv - chord.sy * du;
      left -= signed_distance > on_line;
      right -= signed_distance < -on_line;
      const V size = signed_distance < 0.0 ? -signed_distance : signed_distance;
      const V rounded = (size + magic) - magic;
      simd::store(s.distance.data() + i, rounded);
      sum += rounded;  // Exact, so any grouping gives the same.
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      sides.sum += sum[lane];
      sides.left += static_cast<std::size_t>(left[lane]);
      sides.right += static_cast<std::size_t>(right[lane]);
    }
  }
};

struct SumOfSquares {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const double* distance, std::size_t n, double mean, double magic, double& total) {
    using V = typename simd::Wide<Bytes>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    V sum{};  // Exact, as above.
    std::size_t i = 0;
    for (; i + kLanes <= n; i += kLanes) {
      const V off = simd::load<V>(distance + i) - mean;
      sum += (off * off + magic) - magic;
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) total += sum[lane];
    for (; i < n; ++i) {
      const double off = distance[i] - mean;
      total += (off * off + magic) - magic;
    }
  }
};

void project(const PrincipalFrame& frame, FoldScratch& s) {
  const std::size_t n = s.members.size();
  if (s.u.size() < simd::padded(n)) {
    for (auto* column : {&s.u, &s.v, &s.distance}) column->resize(simd::padded(n));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const BallMember& m = s.members[i];
    s.u[i] = m.dx * frame.e2[0] + m.dy * frame.e2[1] + m.dz * frame.e2[2];
    s.v[i] = m.dx * frame.e3[0] + m.dy * frame.e3[1] + m.dz * frame.e3[2];
  }
}

/// The box around all members, which holds their centre, and how far they reach from it. Arrays are padded to full
/// vectors with the centre.
struct Bounds {
  double left = 0.0, right = 0.0, low = 0.0, high = 0.0, reach2 = 0.0;
};

struct FindBounds {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const FoldScratch& s, std::size_t n, Bounds& bounds) {
    using V = typename simd::Wide<Bytes>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    V left{}, right{}, low{}, high{}, reach2{};
    for (std::size_t i = 0; i < n; i += kLanes) {
      const V u = simd::load<V>(s.u.data() + i), v = simd::load<V>(s.v.data() + i);
      const V d2 = u * u + v * v;
      left = u < left ? u : left;
      right = u > right ? u : right;
      low = v < low ? v : low;
      high = v > high ? v : high;
      reach2 = d2 > reach2 ? d2 : reach2;
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      bounds.left = std::min(bounds.left, left[lane]);
      bounds.right = std::max(bounds.right, right[lane]);
      bounds.low = std::min(bounds.low, low[lane]);
      bounds.high = std::max(bounds.high, high[lane]);
      bounds.reach2 = std::max(bounds.reach2, reach2[lane]);
    }
  }
};

/// Leaves 0 in `distance` for members that are no end.
struct MarkEnds {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(FoldScratch& s, std::size_t n, const Bounds& bounds, double inner, double least) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t i = 0; i < n; i += Bytes / sizeof(double)) {
      const V u = simd::load<V>(s.u.data() + i), v = simd::load<V>(s.v.data() + i);
      const V to_left = u - bounds.left, to_right = bounds.right - u;
      const V to_low = v - bounds.low, to_high = bounds.high - v;
      const V to_side = to_left > to_right ? to_left : to_right;
      const V to_floor = to_low > to_high ? to_low : to_high;
      simd::store(s.distance.data() + i,
                  simd::where_at_most(V{} + inner * inner, u * u + v * v) *
                      simd::where_at_most(V{} + least * least, to_side * to_side + to_floor * to_floor));
    }
  }
};

/// Members that can be an end of the diameter, which is at least as long as the longer side of the box around all. A
/// member is an end only if so far away from it there is still room, both in the box and in the circle around the
/// centre that holds all. The margin covers rounding.
void gather_ends(FoldScratch& s, double radius) {
  const std::size_t n = s.members.size();
  for (std::size_t i = n; i < simd::padded(n); ++i) s.u[i] = s.v[i] = 0.0;
  Bounds bounds;
  simd::dispatch<FindBounds>(s, simd::padded(n), bounds);
  const double least =
      std::max(0.0, std::max(bounds.right - bounds.left, bounds.high - bounds.low) - kEndMargin * radius);
  const double inner = std::max(0.0, least - std::sqrt(bounds.reach2));
  simd::dispatch<MarkEnds>(s, simd::padded(n), bounds, inner, least);
  s.ends.clear();
  for (std::size_t i = 0; i < n; ++i) {
    if (s.distance[i] != 0.0) s.ends.push_back({s.u[i], s.v[i], s.members[i].d2, s.members[i].id});
  }
}

void pick_top(FoldScratch& s, std::size_t count, FoldEmission& emission) {
  const auto stronger = [&s](std::uint32_t a, std::uint32_t b) {
    if (s.distance[a] != s.distance[b]) return s.distance[a] > s.distance[b];
    if (s.members[a].d2 != s.members[b].d2) return s.members[a].d2 < s.members[b].d2;
    return s.members[a].id < s.members[b].id;
  };
  s.top.clear();
  for (std::uint32_t i = 0; i < s.members.size(); ++i) {
    if (s.top.size() == count && !stronger(i, s.top.back())) continue;
    if (s.top.size() == count) s.top.pop_back();
    s.top.insert(std::upper_bound(s.top.begin(), s.top.end(), i, stronger), i);
  }
  for (const std::uint32_t i : s.top) emission.slots.push_back(s.members[i].slot);
}

}  // namespace

void evaluate_fold(const PrincipalFrame& frame, const FoldThresholds& thresholds, FoldScratch& s,
                   FoldEmission& emission) {
  emission.slots.clear();
  const std::size_t n = s.members.size();
  if (n < kLeastBallPoints) return;
  project(frame, s);
  gather_ends(s, thresholds.radius);
  const Diameter diameter = planar_diameter(s.ends, s.hull);
  if (!(diameter.length2 > 0.0)) return;
  const double length = std::sqrt(diameter.length2);
  const Chord chord{diameter.a.x, diameter.a.y, (diameter.b.x - diameter.a.x) / length,
                    (diameter.b.y - diameter.a.y) / length};
  for (std::size_t i = n; i < simd::padded(n); ++i) {
    s.u[i] = chord.x;
    s.v[i] = chord.y;
  }
  const FixedPoint to_line(2.0 * thresholds.radius, n, kDistanceBits);
  Sides sides;
  simd::dispatch<Measure>(s, simd::padded(n), chord, to_line.magic(), kOnLine * thresholds.radius, sides);
  const double mean = sides.sum / static_cast<double>(n);
  const FixedPoint to_square(4.0 * thresholds.radius * thresholds.radius, n, kSquareBits);
  double squares = 0.0;
  simd::dispatch<SumOfSquares>(s.distance.data(), n, mean, to_square.magic(), squares);
  const double cf1 = std::sqrt(squares / static_cast<double>(n - 1));
  if (!(cf1 >= thresholds.cf1)) return;
  const auto majority = static_cast<double>(std::max(sides.left, sides.right));
  const auto minority = static_cast<double>(std::min(sides.left, sides.right));
  // Nobody on one side: infinitely one-sided; nobody on either: 1.
  const bool one_sided =
      minority > 0.0 ? majority >= thresholds.cf2 * minority : majority > 0.0 || thresholds.cf2 <= 1.0;
  if (!one_sided) return;
  pick_top(s, static_cast<std::size_t>(thresholds.top_m), emission);
  emission.strength = static_cast<float>(cf1 / thresholds.cf1);
  emission.angle_deg =
      static_cast<float>(2.0 * kDegreesPerRadian * arc_cosine(std::min(1.0, cf1 / (kFoldLaw * thresholds.radius))));
}

}  // namespace arris
