#include "features/plane_pair.h"

#include <algorithm>
#include <cmath>

namespace arris {
namespace {

constexpr int kRounds = 3;
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

bool improve(const BallPoints& points, PlanePair& pair) {
  double gate = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const SplitSums sums =
        round == 0 ? sum_split(points, pair.split) : sum_split(points, pair.split, pair.a, pair.b, gate);
    if (sums.a.n < kLeastArmPoints || sums.b.n < kLeastArmPoints) return false;
    pair.a = fit_plane(sums.a);
    pair.b = fit_plane(sums.b);
    const double square =
        (pair.a.rms * pair.a.rms * sums.a.n + pair.b.rms * pair.b.rms * sums.b.n) / (sums.a.n + sums.b.n);
    gate = std::max(kGateDeviations * std::sqrt(square), kLeastGate);
    if (!bisect(pair.a, pair.b, pair.split)) return false;
  }
  return true;
}

}  // namespace

PlanePair fit_plane_pair(const BallPoints& points, double radius, const FittedPlane& all) {
  const double diagonal = std::sqrt(0.5);
  Split starts[5] = {{all.e2, 0.0}, {all.e1, 0.0}, {}, {}, {all.normal, all.offset}};
  for (int axis = 0; axis < 3; ++axis) {
    starts[2].g[axis] = diagonal * (all.e1[axis] + all.e2[axis]);
    starts[3].g[axis] = diagonal * (all.e1[axis] - all.e2[axis]);
  }
  PlanePair best;
  for (int start = 0; start < 5; ++start) {
    PlanePair pair;
    pair.split = starts[start];
    if (!improve(points, pair)) continue;
    pair.rms = std::sqrt(mean_cut_square(points, pair.split, pair.a, pair.b, kMostDistance));
    pair.kind = PlanePair::Kind::kArms;
    if (parallel_within(pair.a, pair.b, radius)) {
      const double apart = std::fabs(pair.a.distance(pair.b.centroid[0], pair.b.centroid[1], pair.b.centroid[2]));
      if (start != 4 || pair.rms > kLayerRms * apart) continue;
      pair.kind = PlanePair::Kind::kLayers;
    }
    if (best.kind == PlanePair::Kind::kNone || pair.rms < best.rms) best = pair;
  }
  return best;
}

}  // namespace arris
