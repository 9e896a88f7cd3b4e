#include "features/arris/plane_pair.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include "features/neighbourhood/plane_fits.h"

namespace arris {
namespace {

constexpr int kRounds = 3;
/// Of the starts, so many best ones after the first round are followed to the end.
constexpr std::size_t kFollowedStarts = 2;
constexpr std::size_t kStarts = 5;
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

/// A pair on its way from a start to the end.
struct Way {
  PlanePair pair;
  SplitSums sums;
  double square = std::numeric_limits<double>::infinity();  ///< After the last round; infinite: given up.
  bool along_plane = false;
};

/// Fits both planes of every way to the sums of their sides, and splits at their bisector.
void refit(std::span<Way> ways) {
  PointSums sums[2 * kStarts];
  FittedPlane planes[2 * kStarts];
  std::size_t n = 0;
  for (const Way& way : ways) {
    for (const PointSums& side : {way.sums.a, way.sums.b}) sums[n++] = side;
  }
  fit_planes(std::span(sums, n), std::span(planes, n));
  for (std::size_t i = 0; i < ways.size(); ++i) {
    Way& way = ways[i];
    way.square = std::numeric_limits<double>::infinity();
    const FittedPlane& a = planes[2 * i];
    const FittedPlane& b = planes[2 * i + 1];
    if (way.sums.a.n < kLeastArmPoints || way.sums.b.n < kLeastArmPoints) continue;
    way.pair.a = a;
    way.pair.b = b;
    if (!bisect(a, b, way.pair.split)) continue;
    way.square = (a.rms * a.rms * a.count + b.rms * b.rms * b.count) / (a.count + b.count);
  }
}

/// Moves the ways that are given up to the end and leaves them out; the others stay in order.
std::span<Way> drop_given_up(std::span<Way> ways) {
  const auto end =
      std::stable_partition(ways.begin(), ways.end(), [](const Way& w) { return std::isfinite(w.square); });
  return ways.first(static_cast<std::size_t>(end - ways.begin()));
}

PointSums operator-(const PointSums& a, const PointSums& b) {  // Exact.
  return {a.n - b.n,   a.x - b.x,   a.y - b.y,   a.z - b.z,   a.xx - b.xx,
          a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
}

}  // namespace

PlanePair fit_plane_pair(const BallPoints& points, double radius, const FittedPlane& all) {
  const double diagonal = std::sqrt(0.5);
  Split starts[kStarts] = {{all.e2, 0.0}, {all.e1, 0.0}, {}, {}, {all.normal, all.offset}};
  for (int axis = 0; axis < 3; ++axis) {
    starts[2].g[axis] = diagonal * (all.e1[axis] + all.e2[axis]);
    starts[3].g[axis] = diagonal * (all.e1[axis] - all.e2[axis]);
  }
  Way ways[kStarts];
  const PointSums whole = sum_all(points);
  for (std::size_t i = 0; i < kStarts; ++i) {
    ways[i].pair.split = starts[i];
    ways[i].along_plane = i == kStarts - 1;
    const PointSums a = sum_side(points, starts[i]);
    ways[i].sums = {a, whole - a};
  }
  refit(ways);
  std::stable_sort(std::begin(ways), std::end(ways), [](const Way& a, const Way& b) { return a.square < b.square; });
  std::span<Way> alive = drop_given_up(std::span(ways, kFollowedStarts));
  for (int round = 1; round < kRounds; ++round) {
    for (Way& way : alive) {
      const double gate = std::max(kGateDeviations * std::sqrt(way.square), kLeastGate);
      way.sums = sum_split(points, way.pair.split, way.pair.a, way.pair.b, gate);
    }
    refit(alive);
    alive = drop_given_up(alive);
  }
  PlanePair best;
  for (Way& way : alive) {
    PlanePair& pair = way.pair;
    pair.rms = std::sqrt(mean_cut_square(points, pair.split, pair.a, pair.b, kMostDistance));
    pair.kind = PlanePair::Kind::kArms;
    if (parallel_within(pair.a, pair.b, radius)) {
      const double apart = std::fabs(pair.a.distance(pair.b.centroid[0], pair.b.centroid[1], pair.b.centroid[2]));
      if (!way.along_plane || pair.rms > kLayerRms * apart) continue;
      pair.kind = PlanePair::Kind::kLayers;
    }
    if (best.kind == PlanePair::Kind::kNone || pair.rms < best.rms) best = pair;
  }
  return best;
}

}  // namespace arris
