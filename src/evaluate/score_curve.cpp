#include "evaluate/score_curve.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/parallel.h"

namespace arris::evaluate {

namespace {

constexpr std::size_t kGrain = 4096;

/// (best score of a detection within the limit, length) of every truth sample that has one, best first.
std::vector<std::pair<float, double>> covered_samples(const ScoredDetections& detections, const BoxTree& tree,
                                                      const TruthSamples& truth, double limit) {
  const auto& samples = truth.samples();
  std::vector<std::optional<float>> best(samples.size());
  parallel_for_chunks(samples.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double reach = limit * truth.unit_of(samples[i]);
      double squared_limit = reach * reach;
      tree.search(samples[i].position, squared_limit, [&](std::uint32_t item) {
        const Vec3 difference = detections.positions[item] - samples[i].position;
        if (dot(difference, difference) > squared_limit) return;
        if (!best[i] || detections.scores[item] > *best[i]) best[i] = detections.scores[item];
      });
    }
  });
  std::vector<std::pair<float, double>> covered;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (best[i]) covered.emplace_back(*best[i], samples[i].length);
  }
  std::sort(covered.begin(), covered.end(), std::greater<>());
  return covered;
}

}  // namespace

double average_precision(const ScoredDetections& detections, const BoxTree& tree, const TruthSamples& truth,
                         double limit) {
  std::vector<std::pair<float, bool>> ranked;  // Score, true positive.
  for (std::size_t i = 0; i < detections.scores.size(); ++i) {
    const bool hit = detections.to_truth[i] <= limit;
    if (hit || detections.to_others[i] > limit) ranked.emplace_back(detections.scores[i], hit);
  }
  std::sort(ranked.begin(), ranked.end(), std::greater<>());
  const auto covered = covered_samples(detections, tree, truth, limit);

  double area = 0.0, covered_length = 0.0, hits = 0.0;
  std::size_t next_sample = 0;
  for (std::size_t begin = 0, end = 0; begin < ranked.size(); begin = end) {
    const float threshold = ranked[begin].first;
    for (end = begin; end < ranked.size() && ranked[end].first == threshold; ++end)
      hits += ranked[end].second ? 1.0 : 0.0;
    const double before = covered_length;
    while (next_sample < covered.size() && covered[next_sample].first >= threshold) {
      covered_length += covered[next_sample++].second;
    }
    area += (covered_length - before) * hits / static_cast<double>(end);
  }
  return std::min(1.0, area / truth.total_length());
}

}  // namespace arris::evaluate
