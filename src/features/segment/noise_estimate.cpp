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
/// Planes of neighbourhoods that are nearly lines say nothing of noise.
constexpr double kLeastWidth = 0.01;

/// The value that a share of them is below. Reorders them.
template <class Value, class Of>
double quantile(std::vector<Value>& values, double share, Of&& of) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end(), [&](const Value& a, const Value& b) { return of(a) < of(b); });
  return of(*at);
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
  constexpr double kPoints = kNoiseNeighbours + 1;
  NeighbourhoodBatch::Row variance{};  // l0 + l1 + l2.
  const auto fit = [&] {
    PlaneBatch planes;
    fit_plain_planes(batch, planes);
    for (std::size_t lane = 0; lane < batch.lanes; ++lane) {
      const double width = planes.width[lane];
      if (!(width > kLeastWidth)) continue;
      const double of_noise = planes.variation[lane] * variance[lane];
      const double across = (variance[lane] - of_noise) * std::sqrt(width) / (1.0 + width);
      samples_.push_back({std::sqrt(4.0 * kPi * across / kPoints), std::sqrt(of_noise)});
    }
    batch.lanes = 0;
  };
  std::vector<std::uint32_t> slots(tree.size());
  std::iota(slots.begin(), slots.end(), 0U);
  search.run(slots, [&](std::uint32_t slot, const Neighbours& found) {
    const double reach = std::sqrt(static_cast<double>(found.last_d2)) * (1.0 + 1e-12);
    if (found.count < kNoiseNeighbours || !(reach < static_cast<double>(box.depth(tree.position(slot))))) return;
    const std::size_t lane = batch.lanes++;
    double x = 0.0, y = 0.0, z = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < found.count; ++i) {
      x += batch.x[i][lane] = found.dx[i];
      y += batch.y[i][lane] = found.dy[i];
      z += batch.z[i][lane] = found.dz[i];
      squares += found.d2[i];
    }
    variance[lane] = (squares - (x * x + y * y + z * z) / kPoints) / kPoints;
    if (batch.lanes == kBatchLanes) fit();
  });
  fit();
}

double NoiseEstimate::noise() const {
  std::vector<Sample> samples = samples_;
  const double dense = quantile(samples, 0.25, [](const Sample& s) { return s.spacing; });
  std::erase_if(samples, [&](const Sample& s) { return s.spacing > dense; });
  return quantile(samples, 0.25, [](const Sample& s) { return s.noise; }) / kQuartileShare;
}

double NoiseEstimate::least_spacing() const {
  std::vector<Sample> samples = samples_;
  return quantile(samples, 0.01, [](const Sample& s) { return s.spacing; });
}

}  // namespace arris
