#include "features/liu/liu_runner.h"

#include <algorithm>
#include <cmath>

#include "features/numerics/exact_math.h"

namespace arris {

LiuRunner::LiuRunner(const LiuTask& task)
    : task_(task),
      neighbour_search_(task.tree, task.settings.limits()),
      ball_search_(task.tree, task.settings.switches.narrowest, BallSearch::Exact::kSums) {}

void LiuRunner::run(std::span<const std::uint32_t> slots) {
  balls_.clear();
  thresholds_.clear();
  neighbour_search_.run(slots,
                        [this](std::uint32_t slot, const Neighbours& neighbours) { use_neighbours(slot, neighbours); });
  ball_search_.run(balls_, [this](const auto& candidates, const auto& query, const Ball& ball) {
    test_fold(candidates, query, ball);
  });
}

void LiuRunner::use_neighbours(std::uint32_t slot, const Neighbours& neighbours) {
  const LiuParameters& parameters = task_.settings.parameters;
  const LocalSpacing spacing = task_.settings.spacing(neighbours);
  const FoldThresholds fold = task_.settings.fold_thresholds(spacing);
  if (!proven(slot, neighbours, fold)) return;
  if (neighbours.count < static_cast<std::size_t>(parameters.k_min)) {
    task_.results.add_isolated(slot);
    return;
  }
  if (parameters.boundary) test_boundary(slot, neighbours, spacing);
  if (parameters.fold) {
    balls_.push_back({slot, fold.radius, static_cast<std::uint32_t>(thresholds_.size())});
    thresholds_.push_back(fold);
  }
}

bool LiuRunner::proven(std::uint32_t slot, const Neighbours& neighbours, const FoldThresholds& fold) {
  const LiuSettings& settings = task_.settings;
  const LatticePoint position = task_.tree.position(slot);
  const auto depth =
      static_cast<std::uint64_t>(std::min<std::int64_t>(task_.covered.depth(position), std::int64_t{1} << 31));
  const std::uint64_t seen_d2 = depth * depth;  // Every lattice position nearer than this is covered.
  if (settings.max_d2 < seen_d2) return true;
  const bool full = neighbours.count == static_cast<std::size_t>(settings.parameters.k_max);
  if (full && neighbours.last_d2 < seen_d2 &&
      (!settings.parameters.fold || fold.radius * fold.radius < static_cast<double>(seen_d2))) {
    return true;
  }
  // With k_max neighbours known, unseen points can only bring the last one and the ball closer.
  double reach = settings.max_reach;
  if (full) {
    reach = std::sqrt(static_cast<double>(neighbours.last_d2));
    if (settings.parameters.fold) reach = std::max(reach, fold.radius);
  }
  const double rounded = std::min(std::floor(reach), std::ceil(settings.max_reach)) + 1.0;
  unproven_.push_back({task_.tree.id(slot), position, static_cast<std::int64_t>(rounded)});
  return false;
}

void LiuRunner::test_boundary(std::uint32_t slot, const Neighbours& neighbours, const LocalSpacing& spacing) {
  const ScaleChoice choice = choose_scale(neighbours, task_.settings.scale);
  if (choice.k == 0) return;
  const PrincipalFrame frame = principal_frame(choice.covariance, choice.values);
  GapQuery query;
  query.u = frame.e1;
  query.v = frame.e2;
  query.count = static_cast<std::size_t>(choice.k);
  const double far = task_.settings.far_distance(spacing);
  const auto end = neighbours.d2.begin() + choice.k;
  query.near_count =
      static_cast<std::size_t>(std::upper_bound(neighbours.d2.begin(), end, far * far) - neighbours.d2.begin());
  query.min_offset = 1e-6 * spacing.nearest;
  const AzimuthGapTest& test = task_.settings.gap_test;
  task_.results.add_gap(slot, task_.settings.switches.early_rejection
                                  ? test(neighbours, query, azimuths_)
                                  : test.without_rejection(neighbours, query, azimuths_));
}

template <class T>
void LiuRunner::test_fold(const CandidateSet<T>& candidates, const BallQuery<T>& ball, const Ball& tested) {
  const PointTree& tree = task_.tree;
  const FoldThresholds& thresholds = thresholds_[tested.query];
  const double radius = thresholds.radius;
  const BallMoments moments = ball_moments(candidates, ball);
  if (moments.n < static_cast<double>(kLeastBallPoints)) return;
  const SymmetricMatrix<double> covariance = moments.covariance();
  const bool reject_early = task_.settings.switches.early_rejection;
  const Eigenvalues<double> values = eigenvalues_of(covariance);
  if (reject_early && chord_deviation_bound(values, moments.n, radius) < thresholds.cf1) return;
  const PrincipalFrame frame = principal_frame(covariance, values);
  if (reject_early) {
    const double extent = extent_bound(candidates, ball, frame.e3);
    if (chord_deviation_bound(values, moments.n, radius, extent) < thresholds.cf1) return;
  }
  const std::size_t n = ball_members(candidates, ball, fold_.candidates);
  fold_.members.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t c = fold_.candidates[i];
    const T dx = candidates.x[c] - ball.x;
    const T dy = candidates.y[c] - ball.y;
    const T dz = candidates.z[c] - ball.z;
    const std::uint32_t member = candidates.slot[c];
    fold_.members[i] = {static_cast<double>(dx), static_cast<double>(dy),
                        static_cast<double>(dz), static_cast<double>(dx * dx + dy * dy + dz * dz),
                        tree.id(member),         member};
  }
  evaluate_fold(frame, thresholds, fold_, emission_);
  const bool own_only = task_.settings.parameters.emit == LiuParameters::Emit::kSelf;
  for (const std::uint32_t emitted : emission_.slots) {
    if (!own_only || emitted == tested.slot) task_.results.add_fold(emitted, emission_.strength, emission_.angle_deg);
  }
}

}  // namespace arris
