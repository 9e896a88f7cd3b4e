#pragma once
/// @file The fold test of one ball: chord, distances to it, sides, and the points it emits (Liu et al., eq. 12-24).

#include <cstdint>
#include <limits>
#include <vector>

#include "features/neighbourhood/ball_moments.h"
#include "features/neighbourhood/planar_diameter.h"
#include "features/neighbourhood/point_tree.h"

namespace arris {

/// Fewer points in a ball are no evidence.
constexpr std::size_t kLeastBallPoints = 6;

/// C_f1 of an exact fold of interior angle theta, centred in a ball of radius r: kFoldLaw * r * cos(theta / 2).
constexpr double kFoldLaw = 0.2643;

/// Distances to the chord are rounded to 2^-kDistanceBits of the ball's diameter, their squares to 2^-kSquareBits of
/// its square.
constexpr int kDistanceBits = 30;
constexpr int kSquareBits = 50;
/// Members this close to the chord, in radii, are on it and on neither side.
constexpr double kOnLine = 1e-9;

struct FoldThresholds {
  double radius = 0.0;  ///< r, steps.
  double cf1 = 0.0;     ///< C'_f1, steps, > 0.
  double cf2 = 4.0;     ///< C'_f2.
  int top_m = 3;
};

/// One member of a ball, relative to its centre.
struct BallMember {
  double dx, dy, dz, d2;
  std::uint64_t id;
  std::uint32_t slot;  ///< Tree order.
};

struct FoldEmission {
  std::vector<std::uint32_t> slots;  ///< The top m members by distance to the chord; empty: not a fold.
  float strength = 0.0F;             ///< C_f1 / C'_f1.
  float angle_deg = 0.0F;            ///< Interior angle that C_f1 stands for.
};

/// Reusable memory of evaluate_fold.
struct FoldScratch {
  std::vector<std::uint32_t> candidates;
  std::vector<BallMember> members;
  std::vector<double> u, v, distance;
  std::vector<PlanarPoint> ends, hull;
  std::vector<std::uint32_t> top;
};

/// An upper bound of C_f1 from the ball's shape alone: |signed distance| varies less than the signed distance, and the
/// chord's normal is nearly e3. The chord rises by at most the extent along e3, and is at least as long as 2
/// sqrt(lambda2) and as the extent along e2. Covers rounding. One ball or, with vectors of doubles, many.
/// @param extent3  at least that along e3; may be infinite: then it is bounded by sqrt(2 n lambda3).
/// @param extent2  at most that along e2.
template <class V>
ARRIS_ALWAYS_INLINE V chord_deviation_bound(const Eigenvalues<V>& values, const V& n, const V& radius, const V& extent3,
                                            const V& extent2) {
  const V zero = n - n;
  // Nearly equal values may be off by 1e-8 of the largest, which is at most r².
  const V slack = 1e-7 * radius * radius;
  const V l2 = (values.middle > 0.0 ? values.middle : zero) + slack;
  const V l3 = (values.smallest > 0.0 ? values.smallest : zero) + slack;
  const V extent3_2 = extent3 * extent3;
  const V spread3_2 = 2.0 * n * l3;
  const V rise2 = spread3_2 < extent3_2 ? spread3_2 : extent3_2;
  const V spread2_2 = 4.0 * (values.middle - slack);
  const V extent2_2 = extent2 * extent2;
  const V length2 = spread2_2 > extent2_2 ? spread2_2 : extent2_2;
  const V sine2 = length2 > rise2 ? rise2 / length2 : zero + 1.0;
  const V variance = l3 + (l2 - l3) * sine2;
  return simd::square_root(variance * n / (n - 1.0)) * (1.0 + 1e-6) + 1e-6 * radius;
}
template <class V>
ARRIS_ALWAYS_INLINE V chord_deviation_bound(const Eigenvalues<V>& values, const V& n, const V& radius) {
  const V zero = n - n;
  return chord_deviation_bound(values, n, radius, zero + std::numeric_limits<double>::infinity(), zero);
}

/// The full test on all members of the ball (its centre included) in the ball's principal frame. O(n log n) at worst,
/// about O(n). Law: the outcome does not depend on the order of the members. Distances to the chord are compared after
/// rounding to about 2^-30 r, so that points that tie in exact arithmetic do tie; then the one nearer to the centre
/// wins, then the smaller id.
void evaluate_fold(const PrincipalFrame& frame, const FoldThresholds& thresholds, FoldScratch& scratch,
                   FoldEmission& emission);

}  // namespace arris
