#include "evaluate/boundary_recall.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"
#include "evaluate/box_tree.h"
#include "evaluate/evaluation_setup.h"

namespace arris::evaluate {

namespace {

constexpr std::size_t kGrain = 4096;

/// Squared distance of each of `from` to the nearest of `to`; infinite beyond the reach.
std::vector<double> squared_distances(std::span<const LabelledPoint> points, std::span<const std::uint32_t> from,
                                      std::span<const std::uint32_t> to, double reach) {
  const BoxTree tree(to.size(), [&](std::size_t i) {
    const Vec3& p = points[to[i]].position;
    return Box3{p, p};
  });
  std::vector<double> result(from.size(), std::numeric_limits<double>::infinity());
  parallel_for_chunks(from.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& p = points[from[i]].position;
      double limit = reach * reach;
      tree.search(p, limit, [&](std::uint32_t item) {
        const Vec3 apart = points[to[item]].position - p;
        const double squared = dot(apart, apart);
        if (squared > limit) return;
        limit = result[i] = squared;
      });
    }
  });
  return result;
}

std::optional<double> share_within(std::span<const double> squared, double tolerance) {
  if (squared.empty()) return std::nullopt;
  const double limit = tolerance * (1.0 + kToleranceSlack);
  const auto within = std::count_if(squared.begin(), squared.end(), [&](double s) { return s <= limit * limit; });
  return static_cast<double>(within) / static_cast<double>(squared.size());
}

}  // namespace

std::vector<BoundaryAgreement> compare_boundaries(std::span<const LabelledPoint> points,
                                                  std::span<const std::uint32_t> truth,
                                                  std::span<const std::uint32_t> segmentation,
                                                  std::span<const double> tolerances) {
  if (tolerances.empty()) return {};
  const double reach = *std::max_element(tolerances.begin(), tolerances.end()) * (1.0 + 2.0 * kToleranceSlack);
  const std::vector<double> of_truth = squared_distances(points, truth, segmentation, reach);
  const std::vector<double> of_segmentation = squared_distances(points, segmentation, truth, reach);
  std::vector<BoundaryAgreement> result;
  for (const double tolerance : tolerances) {
    result.push_back({tolerance, share_within(of_truth, tolerance), share_within(of_segmentation, tolerance)});
  }
  return result;
}

}  // namespace arris::evaluate
