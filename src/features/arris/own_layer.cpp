#include "features/arris/own_layer.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace arris {
namespace {

/// Radii of the discs on which the plane is fitted, spacings; the last is the caller's, twice.
constexpr double kFirstDisc = 2.2;
constexpr double kDiscs[] = {2.5, 3.5};
constexpr double kLeastLayerPoints = 5.0;
/// A first disc that scatters more about its plane, or is a string, leaves the layer in doubt.
constexpr double kDoubtfulRms = 0.25;
constexpr double kLeastWidth = 0.3;
/// The vote: planes through the centre and two of so many neighbours, points within this distance of it, on this disc.
constexpr std::size_t kVoters = 10;
constexpr double kVoteGate = 0.4;
constexpr double kVoteDisc = 3.5;
/// Sine of the least angle between the two neighbours.
constexpr double kLeastSine = 0.35;

void find_nearest(const BallPoints& p, std::vector<LayerScratch::Near>& nearest) {
  nearest.clear();
  for (std::size_t i = 0; i < p.count; ++i) {
    const double d2 = p.x[i] * p.x[i] + p.y[i] * p.y[i] + p.z[i] * p.z[i];
    if (d2 > 0.0 && d2 <= kVoteDisc * kVoteDisc) nearest.push_back({d2, p.x[i], p.y[i], p.z[i]});
  }
  const std::size_t wanted = std::min(kVoters, nearest.size());
  const auto before = [](const LayerScratch::Near& a, const LayerScratch::Near& b) {
    return std::tie(a.d2, a.x, a.y, a.z) < std::tie(b.d2, b.x, b.y, b.z);
  };
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(wanted), nearest.end(), before);
  nearest.resize(wanted);
}

/// The plane through the centre and two neighbours with most points about it; false if no two span one.
bool vote(const BallPoints& points, LayerScratch& scratch, FittedPlane& plane) {
  find_nearest(points, scratch.nearest);
  double most = 0.0;
  double least_square = 0.0;
  for (std::size_t i = 1; i < scratch.nearest.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const LayerScratch::Near& a = scratch.nearest[i];
      const LayerScratch::Near& b = scratch.nearest[j];
      Vector3 normal = cross({a.x, a.y, a.z}, {b.x, b.y, b.z});
      const double length2 = dot(normal, normal);
      if (length2 < kLeastSine * kLeastSine * a.d2 * b.d2) continue;
      FittedPlane candidate;
      for (int axis = 0; axis < 3; ++axis) candidate.normal[axis] = normal[axis] / std::sqrt(length2);
      const PointSums sums = sum_near_plane(points, kVoteDisc, candidate, kVoteGate);
      if (sums.n < most) continue;
      const FittedPlane fitted = fit_plane(sums);
      const double square = fitted.rms * fitted.rms;
      if (sums.n == most && square >= least_square) continue;
      most = sums.n;
      least_square = square;
      plane = fitted;
    }
  }
  return most >= kLeastLayerPoints;
}

}  // namespace

FittedPlane own_layer(const BallPoints& points, double radius, double gate, LayerScratch& scratch) {
  const PointSums first = sum_within(points, kFirstDisc);
  FittedPlane plane = fit_plane(first);
  if (first.n < kLeastLayerPoints || plane.rms > kDoubtfulRms || plane.middle_rms < kLeastWidth) {
    vote(points, scratch, plane);
  }
  for (const double disc : {kDiscs[0], kDiscs[1], radius, radius}) {
    const PointSums sums = sum_near_plane(points, std::min(disc, radius), plane, gate);
    if (sums.n < kLeastLayerPoints) break;
    plane = fit_plane(sums);
  }
  return plane;
}

}  // namespace arris
