#include "features/liu/liu_runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "features/neighbourhood/ball_members.h"
#include "features/numerics/exact_math.h"

namespace arris {

LiuRunner::LiuRunner(const LiuTask& task)
    : task_(task),
      neighbour_search_(task.tree, task.settings.limits()),
      ball_search_(task.tree, task.settings.switches.narrowest, BallSearch::Exact::kSums),
      scales_(task.settings.scale) {
  for (Boundary& waiting : boundaries_) waiting.neighbours.reserve(task.settings.limits().k);
}

void LiuRunner::run(std::span<const std::uint32_t> slots) {
  balls_.clear();
  thresholds_.clear();
  neighbour_search_.run(slots,
                        [this](std::uint32_t slot, Neighbours& neighbours) { use_neighbours(slot, neighbours); });
  ball_search_.run_groups(balls_, [this](const auto& candidates, const auto& queries, std::span<const Ball> balls) {
    test_folds(candidates, queries, balls);
  });
}

void LiuRunner::use_neighbours(std::uint32_t slot, Neighbours& neighbours) {
  const LiuParameters& parameters = task_.settings.parameters;
  const LocalSpacing spacing = task_.settings.spacing(neighbours);
  const FoldThresholds fold = task_.settings.fold_thresholds(spacing);
  if (!proven(slot, neighbours, fold)) return;
  if (neighbours.count < static_cast<std::size_t>(parameters.k_min)) {
    task_.results.add_isolated(slot);
    return;
  }
  if (parameters.fold) {
    balls_.push_back({slot, fold.radius, static_cast<std::uint32_t>(thresholds_.size())});
    thresholds_.push_back(fold);
  }
  if (parameters.boundary) {
    Boundary& waiting = boundaries_[boundary_count_];
    waiting.slot = slot;
    waiting.spacing = spacing;
    std::swap(waiting.neighbours, neighbours);
    scales_.set(boundary_count_++, waiting.neighbours);
    if (boundary_count_ == boundaries_.size()) test_boundaries();
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

void LiuRunner::test_boundaries() {
  if (boundary_count_ == 0) return;
  scales_.solve();
  for (std::size_t i = 0; i < boundary_count_; ++i) {
    const ScaleChoice choice = scales_.choice(i);
    frames_.set(i, choice.covariance, choice.values);
  }
  frames_.solve();
  for (std::size_t i = 0; i < boundary_count_; ++i) {
    const int k = scales_.choice(i).k;
    if (k > 0) test_boundary(boundaries_[i], k, frames_.frame(i));
  }
  boundary_count_ = 0;
}

void LiuRunner::test_boundary(const Boundary& tested, int k, const PrincipalFrame& frame) {
  const Neighbours& neighbours = tested.neighbours;
  GapQuery query;
  query.u = frame.e1;
  query.v = frame.e2;
  query.count = static_cast<std::size_t>(k);
  const double far = task_.settings.far_distance(tested.spacing);
  const auto end = neighbours.d2.begin() + k;
  query.near_count =
      static_cast<std::size_t>(std::upper_bound(neighbours.d2.begin(), end, far * far) - neighbours.d2.begin());
  query.min_offset = 1e-6 * tested.spacing.nearest;
  const AzimuthGapTest& test = task_.settings.gap_test;
  task_.results.add_gap(tested.slot, task_.settings.switches.early_rejection
                                         ? test(neighbours, query, azimuths_)
                                         : test.without_rejection(neighbours, query, azimuths_));
}

template <class T>
void LiuRunner::test_folds(const CandidateSet<T>& candidates, std::span<const BallQuery<T>> queries,
                           std::span<const Ball> balls) {
  const auto* left = balls.data();
  const auto* const end = left + balls.size();
  framed_count_ = 0;
  while (left != end) {
    std::array<const Ball*, FoldScreen::kCount> screened{};
    std::size_t count = 0;
    for (; left != end && count < screened.size(); ++left) {
      const BallMoments moments = ball_moments(candidates, queries[static_cast<std::size_t>(left - balls.data())]);
      if (moments.n < static_cast<double>(kLeastBallPoints)) continue;
      screened[count] = left;
      screen_.set(count++, moments, thresholds_[left->query]);
    }
    screen_.solve();
    for (std::size_t i = 0; i < count; ++i) {
      if (task_.settings.switches.early_rejection && !screen_.may_fold(i)) continue;
      frames_.set(framed_count_, screen_.covariance(i), screen_.values(i));
      framed_[framed_count_++] = {screened[i], screen_.points(i)};
      if (framed_count_ == framed_.size()) test_framed(candidates);
    }
  }
  test_framed(candidates);
}

template <class T>
void LiuRunner::test_framed(const CandidateSet<T>& candidates) {
  if (framed_count_ == 0) return;
  frames_.solve();
  for (std::size_t i = 0; i < framed_count_; ++i) {
    const auto& [ball, points] = framed_[i];
    const BallQuery<T> query = query_of(task_.tree, candidates, *ball);
    const PrincipalFrame frame = frames_.frame(i);
    if (task_.settings.switches.early_rejection) {
      const FoldThresholds& thresholds = thresholds_[ball->query];
      const auto [extent2, extent3] = extent_bounds(candidates, query, frame.e2, frame.e3);
      const double bound = chord_deviation_bound(frame.values, points, thresholds.radius, extent3.most, extent2.least);
      if (bound < thresholds.cf1) continue;
    }
    test_fold(candidates, query, *ball, frame);
  }
  framed_count_ = 0;
}

template <class T>
void LiuRunner::test_fold(const CandidateSet<T>& candidates, const BallQuery<T>& ball, const Ball& tested,
                          const PrincipalFrame& frame) {
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
                        task_.tree.id(member),   member};
  }
  evaluate_fold(frame, thresholds_[tested.query], fold_, emission_);
  const bool own_only = task_.settings.parameters.emit == LiuParameters::Emit::kSelf;
  for (const std::uint32_t emitted : emission_.slots) {
    if (!own_only || emitted == tested.slot) task_.results.add_fold(emitted, emission_.strength, emission_.angle_deg);
  }
}

}  // namespace arris
