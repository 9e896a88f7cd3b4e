#include "evaluate/contour_evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "evaluate/corners.h"
#include "evaluate/edge_index.h"
#include "evaluate/evaluation_setup.h"
#include "evaluate/score_curve.h"
#include "evaluate/truth_samples.h"

namespace arris::evaluate {

namespace {

constexpr std::size_t kGrain = 4096;
constexpr double kHighQuantile = 0.95;
constexpr double kCornerJoin = 0.1, kCornerReach = 2.0;  // In spacings.
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Selected detections and their distances, in the order of the predictions.
struct Detections {
  std::vector<Vec3> positions;
  std::vector<float> scores;
  std::vector<double> to_truth;   ///< To the edges that count, in their units.
  std::vector<double> to_others;  ///< To the other edges; infinite unless forgiven kinds are asked for.
};

Detections select(std::span<const PredictedPoint> predictions, const EvaluationOptions& options,
                  ContourEvaluation& result) {
  Detections detections;
  for (const PredictedPoint& p : predictions) {
    const Judgement judgement = judge(p, options);
    if (judgement == Judgement::kMasked) {
      ++result.masked;
    } else if (judgement == Judgement::kNonFinite) {
      ++result.non_finite;
    } else if (judgement == Judgement::kBelowMinScore) {
      ++result.below_min_score;
    } else {
      detections.positions.push_back({p.x, p.y, p.z});
      // A score that is not a number ranks last.
      if (options.scores)
        detections.scores.push_back(std::isnan(p.score) ? -std::numeric_limits<float>::infinity() : p.score);
    }
  }
  if (detections.positions.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw ConfigError("more than 4294967295 detections; evaluate the parts of the scan one by one");
  }
  result.detections = detections.positions.size();
  return detections;
}

std::vector<double> distances_to(const std::vector<TruthEdge>& edges, const std::vector<double>& units,
                                 const std::vector<Vec3>& points, double limit = kInfinity) {
  const EdgeIndex index(edges, units);
  std::vector<double> distances(points.size());
  parallel_for_chunks(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) distances[i] = index.nearest(points[i], limit).distance;
  });
  return distances;
}

std::vector<double> distances_to(const BoxTree& tree, const std::vector<Vec3>& points,
                                 const std::vector<TruthSamples::Sample>& samples) {
  std::vector<double> distances(samples.size());
  parallel_for_chunks(samples.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double limit = kInfinity;
      tree.search(samples[i].position, limit, [&](std::uint32_t item) {
        const Vec3 difference = points[item] - samples[i].position;
        limit = std::min(limit, dot(difference, difference));
      });
      distances[i] = std::sqrt(limit);
    }
  });
  return distances;
}

double median_of_sorted(const std::vector<double>& sorted) {
  const std::size_t n = sorted.size();
  return n % 2 == 1 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]);
}

void judge_detections(const Detections& detections, double limit, ToleranceResult& result) {
  std::vector<double> offsets;
  for (std::size_t i = 0; i < detections.to_truth.size(); ++i) {
    if (detections.to_truth[i] <= limit) {
      offsets.push_back(detections.to_truth[i]);
    } else if (detections.to_others[i] <= limit) {
      ++result.forgiven;
    } else {
      ++result.false_positives;
    }
  }
  result.true_positives = offsets.size();
  const std::uint64_t judged = result.true_positives + result.false_positives;
  if (judged > 0) result.precision = static_cast<double>(result.true_positives) / static_cast<double>(judged);
  if (offsets.empty()) return;
  std::sort(offsets.begin(), offsets.end());
  const double count = static_cast<double>(offsets.size());
  result.offset_mean = std::accumulate(offsets.begin(), offsets.end(), 0.0) / count;
  result.offset_median = median_of_sorted(offsets);
  result.offset_rms = std::sqrt(std::inner_product(offsets.begin(), offsets.end(), offsets.begin(), 0.0) / count);
}

/// Uncovered runs of the samples [begin, end) of one edge. On a closed edge the run over the seam is one.
void count_gaps(const std::vector<double>& distances, std::size_t begin, std::size_t end, bool closed,
                double piece_length, double limit, ToleranceResult& result) {
  const auto open_at = [&](std::size_t i) { return distances[i] > limit; };
  std::vector<std::size_t> runs;
  for (std::size_t i = begin; i < end; ++i) {
    if (!open_at(i)) continue;
    if (i == begin || !open_at(i - 1)) runs.push_back(0);
    ++runs.back();
  }
  if (closed && runs.size() > 1 && open_at(begin) && open_at(end - 1)) {
    runs.front() += runs.back();
    runs.pop_back();
  }
  result.gaps += runs.size();
  for (const std::size_t run : runs)
    result.longest_gap = std::max(result.longest_gap, static_cast<double>(run) * piece_length);
}

double share(double part, double whole) {
  return std::min(1.0, part / whole);
}

void judge_truth(const TruthSamples& truth, const std::vector<TruthEdge>& edges, const std::vector<double>& distances,
                 const EvaluationSetup& setup, double limit, ToleranceResult& result) {
  const auto& samples = truth.samples();
  if (samples.empty()) return;
  std::array<double, kEdgeKinds> covered{}, total{};
  double covered_spacings = 0.0;
  for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end) {
    const TruthEdge& edge = edges[samples[begin].edge];
    std::size_t hits = 0;
    for (end = begin; end < samples.size() && samples[end].edge == samples[begin].edge; ++end) {
      if (distances[end] <= limit) ++hits;
    }
    const double piece_length = samples[begin].length;
    const std::size_t kind = static_cast<std::size_t>(edge.kind);
    covered[kind] += static_cast<double>(hits) * piece_length;
    covered_spacings +=
        static_cast<double>(hits) * piece_length / (setup.local ? truth.unit_of(samples[begin]) : setup.spacing);
    total[kind] += static_cast<double>(end - begin) * piece_length;
    count_gaps(distances, begin, end, edge.closed(), piece_length, limit, result);
  }
  for (std::size_t kind = 0; kind < kEdgeKinds; ++kind) {
    if (total[kind] > 0.0) result.recall_of_kind[kind] = share(covered[kind], total[kind]);
  }
  const double covered_length = std::accumulate(covered.begin(), covered.end(), 0.0);
  const double total_length = std::accumulate(total.begin(), total.end(), 0.0);
  result.recall = share(covered_length, total_length);
  result.gaps_per_length = static_cast<double>(result.gaps) / total_length;
  if (covered_spacings > 0.0) result.thinness = static_cast<double>(result.true_positives) / covered_spacings;
  const double sum = result.precision.value_or(0.0) + *result.recall;
  result.f1 = sum > 0.0 ? 2.0 * result.precision.value_or(0.0) * *result.recall / sum : 0.0;
}

/// Smallest distance that at least `quantile` of the weight does not exceed.
template <class WeightOf>
double weighted_quantile(const std::vector<double>& values, double quantile, const WeightOf& weight_of) {
  std::vector<std::uint32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return values[i] < values[j]; });
  double total = 0.0;
  for (const std::uint32_t i : order) total += weight_of(i);
  double reached = 0.0;
  for (const std::uint32_t i : order) {
    reached += weight_of(i);
    if (reached >= quantile * total * (1.0 - 1e-12)) return values[i];
  }
  return values[order.back()];
}

void judge_whole_sets(const std::vector<double>& to_truth, const std::vector<double>& to_detections,
                      const std::vector<TruthSamples::Sample>& samples, ContourEvaluation& result) {
  if (to_truth.empty() || to_detections.empty()) return;
  double weighted = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) weighted += samples[i].length * to_detections[i];
  result.mean_to_truth = std::accumulate(to_truth.begin(), to_truth.end(), 0.0) / static_cast<double>(to_truth.size());
  result.mean_to_detections = weighted / result.truth_length;
  result.chamfer = 0.5 * (*result.mean_to_truth + *result.mean_to_detections);
  result.hausdorff = std::max(*std::max_element(to_truth.begin(), to_truth.end()),
                              *std::max_element(to_detections.begin(), to_detections.end()));
  result.hausdorff_95 =
      std::max(weighted_quantile(to_truth, kHighQuantile, [](std::size_t) { return 1.0; }),
               weighted_quantile(to_detections, kHighQuantile, [&](std::size_t i) { return samples[i].length; }));
}

double covered_share(const std::vector<double>& distances, const std::vector<TruthSamples::Sample>& samples,
                     double limit) {
  double covered = 0.0, total = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    total += samples[i].length;
    if (distances[i] <= limit) covered += samples[i].length;
  }
  return share(covered, total);
}

/// Which samples lie within two spacings of a corner of the whole truth.
std::vector<char> near_corners(const std::vector<TruthEdge>& edges, const TruthSamples& truth,
                               const EvaluationSetup& setup) {
  const Corners corners(edges, kCornerJoin * setup.spacing);
  const auto& samples = truth.samples();
  std::vector<char> near(samples.size(), 0);
  parallel_for_chunks(samples.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double spacing = setup.local ? truth.unit_of(samples[i]) : setup.spacing;
      near[i] = corners.within(samples[i].position, kCornerReach * spacing) ? 1 : 0;
    }
  });
  return near;
}

/// Length of the chosen samples; of those among them that a detection covers.
std::array<double, 2> chosen_length(const TruthSamples& truth, const std::vector<char>& chosen,
                                    const std::vector<double>& distances, double limit) {
  double all = 0.0, covered = 0.0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i] == 0) continue;
    all += truth.samples()[i].length;
    if (distances[i] <= limit) covered += truth.samples()[i].length;
  }
  return {all, covered};
}

}  // namespace

ContourEvaluation evaluate_contours(std::span<const PredictedPoint> predictions, const Truth& truth,
                                    const EvaluationOptions& options, const InputCoverage* input) {
  const EvaluationSetup setup = prepare(truth, options);
  ContourEvaluation result;
  result.spacing = setup.spacing;
  result.noise = setup.noise;
  result.truth_edges = setup.counted.size();
  result.spacing_of = options.spacing_of;
  const TruthSamples samples(setup.counted, sample_step(setup), setup.units);
  result.truth_length = samples.total_length();

  Detections detections = select(predictions, options, result);
  // With local units far distances mean nothing, and are slow to find.
  const double farthest = setup.local ? setup.tolerances.back() * (1.0 + kToleranceSlack) : kInfinity;
  detections.to_truth = distances_to(setup.counted, setup.units, detections.positions, farthest);
  detections.to_others = options.forgive_other_kinds
                             ? distances_to(setup.others, setup.other_units, detections.positions, farthest)
                             : std::vector<double>(detections.positions.size(), kInfinity);
  const BoxTree tree(detections.positions.size(), [&](std::size_t i) {
    return Box3{detections.positions[i], detections.positions[i]};
  });
  const std::vector<double> to_detections = distances_to(tree, detections.positions, samples.samples());
  std::vector<double> to_detections_in_units = to_detections;
  for (std::size_t i = 0; i < to_detections.size(); ++i) {
    to_detections_in_units[i] /= samples.unit_of(samples.samples()[i]);
  }
  const std::vector<double> to_input = input != nullptr ? input->distances() : std::vector<double>{};
  if (input != nullptr && to_input.size() != samples.samples().size()) {
    throw ConfigError("the coverage of the input was computed with other options than the evaluation");
  }

  const std::vector<char> at_corner = near_corners(truth.edges, samples, setup);
  for (const double tolerance : setup.tolerances) {
    ToleranceResult row;
    row.tolerance = tolerance;
    const double limit = tolerance * (1.0 + kToleranceSlack);
    judge_detections(detections, limit, row);
    judge_truth(samples, setup.counted, to_detections_in_units, setup, limit, row);
    const auto [corners, covered] = chosen_length(samples, at_corner, to_detections_in_units, limit);
    result.corner_length = corners;
    if (corners > 0.0) row.recall_of_corners = share(covered, corners);
    if (input != nullptr && row.recall) row.ceiling = covered_share(to_input, samples.samples(), limit);
    if (options.scores && row.recall) {
      row.average_precision = average_precision(
          {detections.positions, detections.scores, detections.to_truth, detections.to_others}, tree, samples, limit);
    }
    result.tolerances.push_back(row);
  }
  judge_whole_sets(setup.local ? distances_to(setup.counted, {}, detections.positions) : detections.to_truth,
                   to_detections, samples.samples(), result);
  return result;
}

}  // namespace arris::evaluate
