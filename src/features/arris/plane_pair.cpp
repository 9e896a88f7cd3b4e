#include "features/arris/plane_pair.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace arris {
namespace {

constexpr int kRounds = 3;
/// Of the starts, so many best ones after the first round are followed to the end.
constexpr int kFollowedStarts = 2;
/// Points farther from their arm than this many rms, but at least so many spacings, are left out of the next fit.
constexpr double kGateDeviations = 2.5;
constexpr double kLeastGate = 0.3;
constexpr double kLeastArmPoints = 6.0;
/// No single point weighs more than this distance, spacings: a third surface must not decide between two others.
constexpr double kMostDistance = 1.5;
/// Sheets are layers, and not the two halves of one noisy sheet (for which this is 0.375), if their rms is below this
/// share of their distance.
constexpr double kLayerRms = 0.2;

/// The bisector of two planes that parts their points' centroids best; false if neither does.
bool bisect(const FittedPlane& a, const FittedPlane& b, Split& split) {
  double best = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    Vector3 g;
    for (int axis = 0; axis < 3; ++axis) g[axis] = a.normal[axis] + sign * b.normal[axis];
    const double length = std::sqrt(dot(g, g));
    if (length < 1e-9) continue;
    const double h = a.offset + sign * b.offset;
    const double at_a = dot(g, a.centroid) - h;
    const double at_b = dot(g, b.centroid) - h;
    if (at_a * at_b >= 0.0) continue;
    const double margin = std::min(std::fabs(at_a), std::fabs(at_b)) / length;
    if (margin <= best) continue;
    best = margin;
    const double scale = (at_a > 0.0 ? 1.0 : -1.0) / length;
    split = {{g[0] * scale, g[1] * scale, g[2] * scale}, h * scale};
  }
  return best > 0.0;
}

/// True if the planes do not meet within the ball.
bool parallel_within(const FittedPlane& a, const FittedPlane& b, double radius) {
  const Vector3 e = cross(a.normal, b.normal);
  const double sine2 = dot(e, e);
  if (sine2 < 1e-8) return true;
  const Vector3 u = cross(b.normal, e);
  const Vector3 v = cross(e, a.normal);
  double distance2 = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double foot = (a.offset * u[axis] + b.offset * v[axis]) / sine2;
    distance2 += foot * foot;
  }
  return distance2 > radius * radius;
}

/// Fits both planes to the sums of their sides and splits at their bisector.
/// @param square  mean squared distance of the points to the plane of their side.
bool refit(const SplitSums& sums, PlanePair& pair, double& square) {
  if (sums.a.n < kLeastArmPoints || sums.b.n < kLeastArmPoints) return false;
  pair.a = fit_plane(sums.a);
  pair.b = fit_plane(sums.b);
  square = (pair.a.rms * pair.a.rms * sums.a.n + pair.b.rms * pair.b.rms * sums.b.n) / (sums.a.n + sums.b.n);
  return bisect(pair.a, pair.b, pair.split);
}

struct Start {
  PlanePair pair;
  double square = std::numeric_limits<double>::infinity();  ///< After the first round; infinite: given up.
  bool along_plane = false;
};

}  // namespace

PlanePair fit_plane_pair(const BallPoints& points, double radius, const FittedPlane& all) {
  const double diagonal = std::sqrt(0.5);
  Split starts[5] = {{all.e2, 0.0}, {all.e1, 0.0}, {}, {}, {all.normal, all.offset}};
  for (int axis = 0; axis < 3; ++axis) {
    starts[2].g[axis] = diagonal * (all.e1[axis] + all.e2[axis]);
    starts[3].g[axis] = diagonal * (all.e1[axis] - all.e2[axis]);
  }
  Start ways[5];
  for (int i = 0; i < 5; ++i) {
    Start& way = ways[i];
    way.pair.split = starts[i];
    way.along_plane = i == 4;
    double square = 0.0;
    if (refit(sum_split(points, way.pair.split), way.pair, square)) way.square = square;
  }
  std::stable_sort(std::begin(ways), std::end(ways),
                   [](const Start& a, const Start& b) { return a.square < b.square; });
  PlanePair best;
  for (int i = 0; i < kFollowedStarts && std::isfinite(ways[i].square); ++i) {
    PlanePair& pair = ways[i].pair;
    double square = ways[i].square;
    bool alive = true;
    for (int round = 1; round < kRounds && alive; ++round) {
      const double gate = std::max(kGateDeviations * std::sqrt(square), kLeastGate);
      alive = refit(sum_split(points, pair.split, pair.a, pair.b, gate), pair, square);
    }
    if (!alive) continue;
    pair.rms = std::sqrt(mean_cut_square(points, pair.split, pair.a, pair.b, kMostDistance));
    pair.kind = PlanePair::Kind::kArms;
    if (parallel_within(pair.a, pair.b, radius)) {
      const double apart = std::fabs(pair.a.distance(pair.b.centroid[0], pair.b.centroid[1], pair.b.centroid[2]));
      if (!ways[i].along_plane || pair.rms > kLayerRms * apart) continue;
      pair.kind = PlanePair::Kind::kLayers;
    }
    if (best.kind == PlanePair::Kind::kNone || pair.rms < best.rms) best = pair;
  }
  return best;
}

}  // namespace arris
