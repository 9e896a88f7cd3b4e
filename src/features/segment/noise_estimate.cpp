#include "features/segment/noise_estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "features/neighbourhood/neighbour_search.h"
#include "features/segment/robust_plane.h"

namespace arris {
namespace {

/// What the first quartile of root mean squared residuals of planes through 13 points is of the noise.
constexpr double kQuartileShare = 0.72;
constexpr double kNoiseOfEight = 0.11;
constexpr std::size_t kLeast = 8, kMost = 32;
/// Planes of neighbourhoods that are nearly lines say nothing of noise.
constexpr double kLeastWidth = 0.01;

double noise_of(const PlaneBatch& planes, std::size_t lane) {
  const double w = planes.width[lane];
  const double k = static_cast<double>(kNoiseNeighbours + 1);
  return std::sqrt(planes.variation[lane] * (1.0 + w) / std::sqrt(w) * k / (4.0 * kPi));
}

}  // namespace

void NoiseEstimate::add(std::span<const LatticePoint> points, const LatticeBox& box) {
  if (points.size() <= kNoiseNeighbours) return;
  std::vector<LatticePoint> unique(points.begin(), points.end());
  std::sort(unique.begin(), unique.end());
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
  std::vector<std::uint64_t> ids(unique.size());
  std::iota(ids.begin(), ids.end(), std::uint64_t{0});  // By position: ties do not depend on the order of the inputs.
  const PointTree tree(unique, ids);
  const double side = static_cast<double>(box.max[0] - box.min[0]);
  NeighbourSearch search(tree, {kNoiseNeighbours, side, static_cast<std::uint64_t>(side * side), Arithmetic::kFloat});
  NeighbourhoodBatch batch;
  batch.neighbours = kNoiseNeighbours;
  batch.mean_distance.fill(1.0);
  const auto fit = [&] {
    PlaneBatch planes;
    fit_plain_planes(batch, planes);
    for (std::size_t lane = 0; lane < batch.lanes; ++lane)
      if (planes.width[lane] > kLeastWidth) noise_.push_back(noise_of(planes, lane));
    batch.lanes = 0;
  };
  std::vector<std::uint32_t> slots(tree.size());
  std::iota(slots.begin(), slots.end(), 0U);
  search.run(slots, [&](std::uint32_t slot, const Neighbours& found) {
    const double reach = std::sqrt(static_cast<double>(found.last_d2)) * (1.0 + 1e-12);
    if (found.count < kNoiseNeighbours || !(reach < static_cast<double>(box.depth(tree.position(slot))))) return;
    const std::size_t lane = batch.lanes++;
    for (std::size_t i = 0; i < found.count; ++i) {
      batch.x[i][lane] = found.dx[i];
      batch.y[i][lane] = found.dy[i];
      batch.z[i][lane] = found.dz[i];
    }
    if (batch.lanes == kBatchLanes) fit();
  });
  fit();
}

double NoiseEstimate::noise_over_spacing() const {
  if (noise_.empty()) return 0.0;
  std::vector<double> sorted = noise_;
  const auto quartile = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 4);
  std::nth_element(sorted.begin(), quartile, sorted.end());
  return *quartile / kQuartileShare;
}

std::size_t neighbours_for(double noise_over_spacing) {
  const double wanted = std::ceil(static_cast<double>(kLeast) * noise_over_spacing / kNoiseOfEight);
  return wanted < static_cast<double>(kMost) ? std::max(kLeast, static_cast<std::size_t>(wanted)) : kMost;
}

}  // namespace arris
