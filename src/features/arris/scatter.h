#pragma once
/// @file Whether the points of a ball scatter about one plane, which is most of what is not flat in a noisy scan.

#include <span>
#include <vector>

#include "features/arris/point_analysis.h"

namespace arris {

/// Reusable memory.
struct ScatterScratch {
  std::vector<BallPoints> near_points;
  std::vector<const BallPoints*> near_balls;
  std::vector<PointSums> sums;
  std::vector<FittedPlane> near, all;
  std::vector<double> near_shares, shares;
};

/// False if the shapes of the first and of the near ball say already that there is more to it, or that there is no fold
/// to be ruled out.
bool may_scatter(const PointProspects& prospects);

/// True for the first balls that show no bend, neither as a whole nor next to the point: their points scatter about a
/// plane. Law: a function of the set of points of a ball only, however many balls are asked about. O(points).
/// @param scatters  as many as balls; 0 or 1.
void find_scatter(std::span<const BallPoints* const> balls, ScatterScratch& scratch, std::span<std::uint8_t> scatters);

}  // namespace arris
