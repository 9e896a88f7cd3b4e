#include "features/arris/scatter.h"

#include <algorithm>

#include "features/arris/quadric_share.h"
#include "features/neighbourhood/plane_fits.h"

namespace arris {
namespace {

/// Share of the scatter that a bent surface leaves, at most, of a fold in the first and in the near ball.
constexpr double kBendShare = 0.9;
constexpr double kNearBendShare = 0.8;
/// Scatter is the same in the near and in the first ball; folds, also acute ones that no quadric over one plane
/// follows, grow by 5 / 3.
constexpr double kScatterGrowth = 1.35;
/// Share of the points within half an rms of their plane: 0.38 for noise, about 0 for two layers.
constexpr double kLeastCoreShare = 0.25;

/// Planes through the points within `radius`, and what bent surfaces leave of their scatter.
void compare_surfaces(std::span<const BallPoints* const> balls, double radius, std::vector<PointSums>& sums,
                      std::vector<FittedPlane>& planes, std::vector<double>& shares) {
  sums.clear();
  for (const BallPoints* ball : balls) sums.push_back(sum_within(*ball, radius));
  planes.resize(balls.size());
  shares.resize(balls.size());
  fit_planes(sums, planes);
  quadric_shares(balls, radius, planes, shares);
}

}  // namespace

bool may_scatter(const PointProspects& p) {
  return p.fold && p.rms < std::min(kMostNoise, kScatterGrowth * p.near_rms);
}

void find_scatter(std::span<const BallPoints* const> balls, ScatterScratch& s, std::span<std::uint8_t> scatters) {
  s.near_points.resize(std::max(s.near_points.size(), balls.size()));
  s.near_balls.clear();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    keep_within(*balls[i], kNearRadius, s.near_points[i]);
    s.near_balls.push_back(&s.near_points[i]);
  }
  compare_surfaces(s.near_balls, kNearRadius, s.sums, s.near, s.near_shares);
  compare_surfaces(balls, kBallRadii[0], s.sums, s.all, s.shares);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    scatters[i] = 0;
    if (s.near_shares[i] < kNearBendShare || s.shares[i] < kBendShare) continue;
    // Two layers do not bend either, but between them there is nothing.
    const FittedPlane& plane = s.all[i];
    const double core = count_near_plane(*balls[i], kBallRadii[0], plane, 0.5 * plane.rms);
    scatters[i] = core >= kLeastCoreShare * plane.count ? 1 : 0;
  }
}

}  // namespace arris
