#include "features/arris/own_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// The points on the disc of the vote, and the nearest of them, but for the centre.
void find_voters(const BallPoints& p, LayerScratch& scratch) {
  BallPoints& disc = scratch.disc;
  keep_within(p, kVoteDisc, disc);
  scratch.nearest.clear();
  for (std::size_t i = 0; i < disc.count; ++i) {
    const double x = disc.x[i], y = disc.y[i], z = disc.z[i];
    const double d2 = x * x + y * y + z * z;
    if (d2 > 0.0) scratch.nearest.push_back({d2, x, y, z});
  }
  const std::size_t wanted = std::min(kVoters, scratch.nearest.size());
  const auto before = [](const LayerScratch::Near& a, const LayerScratch::Near& b) {
    return std::tie(a.d2, a.x, a.y, a.z) < std::tie(b.d2, b.x, b.y, b.z);
  };
  std::partial_sort(scratch.nearest.begin(), scratch.nearest.begin() + static_cast<std::ptrdiff_t>(wanted),
                    scratch.nearest.end(), before);
  scratch.nearest.resize(wanted);
}

/// The planes through the centre and two of the nearest neighbours.
void span_candidates(LayerScratch& scratch) {
  scratch.candidates.clear();
  for (std::size_t i = 1; i < scratch.nearest.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const LayerScratch::Near& a = scratch.nearest[i];
      const LayerScratch::Near& b = scratch.nearest[j];
      const Vector3 normal = cross({a.x, a.y, a.z}, {b.x, b.y, b.z});
      const double length2 = dot(normal, normal);
      if (length2 < kLeastSine * kLeastSine * a.d2 * b.d2) continue;
      FittedPlane& candidate = scratch.candidates.emplace_back();
      for (int axis = 0; axis < 3; ++axis) candidate.normal[axis] = normal[axis] / std::sqrt(length2);
      candidate.count = count_near_plane(scratch.disc, kVoteDisc, candidate, kVoteGate);
    }
  }
}

/// The plane through the centre and two neighbours with most points about it, of several the one that fits best; stays
/// as it is if no two span one.
void vote(const BallPoints& points, LayerScratch& scratch, FittedPlane& plane) {
  find_voters(points, scratch);
  span_candidates(scratch);
  double most = 0.0;
  for (const FittedPlane& candidate : scratch.candidates) most = std::max(most, candidate.count);
  double least_square = std::numeric_limits<double>::infinity();
  for (const FittedPlane& candidate : scratch.candidates) {
    if (candidate.count < most) continue;
    const FittedPlane fitted = fit_plane(sum_near_plane(scratch.disc, kVoteDisc, candidate, kVoteGate));
    const double square = fitted.rms * fitted.rms;
    if (square >= least_square) continue;
    least_square = square;
    plane = fitted;
  }
}

}  // namespace

FittedPlane own_layer(const BallPoints& points, double radius, double gate, LayerScratch& scratch) {
  const PointSums first = sum_within(points, kFirstDisc);
  FittedPlane plane = fit_plane(first);
  if (first.n < kLeastLayerPoints || plane.rms > kDoubtfulRms || plane.middle_rms < kLeastWidth) {
    vote(points, scratch, plane);
  }
  PointSums before;
  for (const double disc : {kDiscs[0], kDiscs[1], radius, radius}) {
    const PointSums sums = sum_near_plane(points, std::min(disc, radius), plane, gate);
    if (sums.n < kLeastLayerPoints) break;
    if (sums == before) continue;  // The same points: the same plane.
    plane = fit_plane(sums);
    before = sums;
  }
  return plane;
}

}  // namespace arris
