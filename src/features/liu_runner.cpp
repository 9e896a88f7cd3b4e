#include "features/liu_runner.h"

#include <algorithm>
#include <cmath>

#include "features/exact_math.h"

namespace arris {
namespace {

/// Reaches are guessed this much above the mean need of the bucket before: most queries then need no second gathering, and
/// candidates stay few.
constexpr double kNearMargin = 1.18;
constexpr double kFarMargin = 1.08;

ClosedBox box_of(const PointTree& tree, std::span<const std::uint32_t> slots) {
  ClosedBox box = tree.bounds(slots[0], slots[0] + 1);
  for (const std::uint32_t slot : slots) {
    const LatticePoint p = tree.position(slot);
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], p[axis]);
      box.max[axis] = std::max(box.max[axis], p[axis]);
    }
  }
  return box;
}

/// floor(reach²) as an exact T, at most max_d2.
template <class T>
T squared_limit(double reach, std::uint64_t max_d2) {
  return static_cast<T>(std::min(static_cast<std::uint64_t>(reach * reach), max_d2));
}

}  // namespace

LiuRunner::LiuRunner(const LiuTask& task) : task_(task) {
  neighbours_.reserve(static_cast<std::size_t>(task.settings.parameters.k_max));
}

void LiuRunner::run(std::span<const std::uint32_t> slots) {
  if (slots.empty()) return;
  const GatherReach reach = expected_reach(slots);
  near_sum_ = far_sum_ = 0.0;
  measured_ = 0;
  run_group(slots, reach);
  while (!retries_.empty()) {
    const Retry retry = retries_.back();
    retries_.pop_back();
    run_group(std::span(&retry.slot, 1), {retry.reach, retry.reach});
  }
}

GatherReach LiuRunner::expected_reach(std::span<const std::uint32_t> slots) const {
  const LiuParameters& p = task_.settings.parameters;
  double near = 0.0;
  double far = 0.0;
  if (measured_ > 0) {
    near = kNearMargin * near_sum_ / static_cast<double>(measured_);
    far = kFarMargin * far_sum_ / static_cast<double>(measured_);
  } else {
    // As if the bucket's points lay on a plane that its two longest sides span.
    const ClosedBox box = box_of(task_.tree, slots);
    double sides[3];
    for (int axis = 0; axis < 3; ++axis) sides[axis] = static_cast<double>(box.max[axis]) - box.min[axis] + 1.0;
    std::sort(std::begin(sides), std::end(sides));
    const double spacing = std::sqrt(sides[1] * sides[2] / static_cast<double>(slots.size()));
    near = 1.5 * spacing * std::sqrt(p.k_max / kPi);
    if (p.fold) far = p.radius > 0.0 ? p.radius / task_.settings.step : 1.2 * p.radius_factor * spacing;
  }
  near = std::min(std::max(near, 2.0), task_.settings.max_reach);
  far = std::clamp(far, near, task_.settings.max_reach);
  return {near, far};
}

void LiuRunner::run_group(std::span<const std::uint32_t> slots, const GatherReach& reach) {
  const ClosedBox box = box_of(task_.tree, slots);
  const auto narrowest = task_.settings.switches.narrowest;
  using Narrowest = LiuSwitches::Arithmetic;
  if (narrowest <= Narrowest::kFloat && try_group(floats_, box, slots, reach)) return;
  if (narrowest <= Narrowest::kDouble && try_group(doubles_, box, slots, reach)) return;
  try_group(integers_, box, slots, reach);
}

template <class T>
bool LiuRunner::try_group(Arithmetic<T>& arithmetic, const ClosedBox& box, std::span<const std::uint32_t> slots,
                          const GatherReach& reach) {
  // One step of slack: the gathering reaches a step farther than asked for.
  if ((reach.far + 1.0) * (reach.far + 1.0) >= kExactSquares<T>) return false;
  if (!arithmetic.candidates.gather(task_.tree, box, reach)) return false;
  if (!ball_sums_are_exact<T>(reach.far, arithmetic.candidates.count)) return false;
  arithmetic.guess_d2 = squared_limit<T>(reach.near / kNearMargin, task_.settings.max_d2);
  for (const std::uint32_t slot : slots) run_query(arithmetic, slot);
  return true;
}

template <class T>
bool LiuRunner::find_neighbours(Arithmetic<T>& arithmetic, std::uint32_t slot) {
  const LiuSettings& settings = task_.settings;
  const CandidateSet<T>& candidates = arithmetic.candidates;
  const PointTree& tree = task_.tree;
  NearestQuery<T> query;
  query.x = static_cast<T>(tree.x()[slot] - candidates.origin[0]);
  query.y = static_cast<T>(tree.y()[slot] - candidates.origin[1]);
  query.z = static_cast<T>(tree.z()[slot] - candidates.origin[2]);
  query.k = static_cast<std::size_t>(settings.parameters.k_max);
  query.max_d2 = squared_limit<T>(candidates.reach.near, settings.max_d2);
  query.guess_d2 = arithmetic.guess_d2;
  select_nearest(tree, candidates, candidates.near_count, query, arithmetic.nearest, neighbours_);
  const auto complete = [&] {
    return neighbours_.count == query.k || static_cast<std::uint64_t>(query.max_d2) == settings.max_d2;
  };
  if (!complete() && candidates.reach.far > candidates.reach.near) {
    query.max_d2 = squared_limit<T>(candidates.reach.far, settings.max_d2);
    select_nearest(tree, candidates, candidates.count, query, arithmetic.nearest, neighbours_);
  }
  if (!complete()) {
    // R_max² may be no whole number: at R_max itself every neighbour is found.
    retries_.push_back({slot, std::min(1.5 * candidates.reach.far + 1.0, settings.max_reach)});
    return false;
  }
  if (neighbours_.count == query.k) {
    arithmetic.guess_d2 = static_cast<T>(1.15 * static_cast<double>(neighbours_.last_d2) + 1.0);
  }
  return true;
}

bool LiuRunner::proven(std::uint32_t slot, const FoldThresholds& fold) {
  const LiuSettings& settings = task_.settings;
  const LatticePoint position = task_.tree.position(slot);
  const auto depth = static_cast<std::uint64_t>(std::min<std::int64_t>(task_.covered.depth(position), std::int64_t{1} << 31));
  const std::uint64_t seen_d2 = depth * depth;  // Every lattice position nearer than this is covered.
  if (settings.max_d2 < seen_d2) return true;
  const bool full = neighbours_.count == static_cast<std::size_t>(settings.parameters.k_max);
  if (full && neighbours_.last_d2 < seen_d2 && (!settings.parameters.fold || fold.radius * fold.radius < static_cast<double>(seen_d2))) {
    return true;
  }
  // With k_max neighbours known, unseen points can only bring the last one and the ball closer.
  double reach = settings.max_reach;
  if (full) {
    reach = std::sqrt(static_cast<double>(neighbours_.last_d2));
    if (settings.parameters.fold) reach = std::max(reach, fold.radius);
  }
  const double rounded = std::min(std::floor(reach), std::ceil(settings.max_reach)) + 1.0;
  unproven_.push_back({task_.tree.id(slot), position, static_cast<std::int64_t>(rounded)});
  return false;
}

template <class T>
void LiuRunner::run_query(Arithmetic<T>& arithmetic, std::uint32_t slot) {
  const LiuSettings& settings = task_.settings;
  const LiuParameters& parameters = settings.parameters;
  if (!find_neighbours(arithmetic, slot)) return;
  const LocalSpacing spacing = settings.spacing(neighbours_);
  const FoldThresholds fold = settings.fold_thresholds(spacing);
  if (parameters.fold && fold.radius > arithmetic.candidates.reach.far) {
    retries_.push_back({slot, fold.radius});
    return;
  }
  near_sum_ += std::sqrt(static_cast<double>(neighbours_.last_d2));
  far_sum_ += fold.radius;
  ++measured_;
  if (!proven(slot, fold)) return;
  if (neighbours_.count < static_cast<std::size_t>(parameters.k_min)) {
    task_.results.add_isolated(slot);
    return;
  }
  if (parameters.boundary) test_boundary(slot, spacing);
  if (parameters.fold) test_fold(arithmetic, slot, fold);
}

void LiuRunner::test_boundary(std::uint32_t slot, const LocalSpacing& spacing) {
  const ScaleChoice choice = choose_scale(neighbours_, task_.settings.scale);
  if (choice.k == 0) return;
  const PrincipalFrame frame = principal_frame(choice.covariance);
  GapQuery query;
  query.u = frame.e1;
  query.v = frame.e2;
  query.count = static_cast<std::size_t>(choice.k);
  const double far = task_.settings.far_distance(spacing);
  const auto end = neighbours_.d2.begin() + choice.k;
  query.near_count = static_cast<std::size_t>(std::upper_bound(neighbours_.d2.begin(), end, far * far) - neighbours_.d2.begin());
  query.min_offset = 1e-6 * spacing.nearest;
  const AzimuthGapTest& test = task_.settings.gap_test;
  task_.results.add_gap(slot, task_.settings.switches.early_rejection ? test(neighbours_, query, azimuths_)
                                                                      : test.without_rejection(neighbours_, query, azimuths_));
}

template <class T>
void LiuRunner::test_fold(const Arithmetic<T>& arithmetic, std::uint32_t slot, const FoldThresholds& thresholds) {
  const PointTree& tree = task_.tree;
  const CandidateSet<T>& candidates = arithmetic.candidates;
  const BallQuery<T> ball{static_cast<T>(tree.x()[slot] - candidates.origin[0]), static_cast<T>(tree.y()[slot] - candidates.origin[1]),
                          static_cast<T>(tree.z()[slot] - candidates.origin[2]),
                          static_cast<T>(static_cast<std::uint64_t>(thresholds.radius * thresholds.radius))};
  const BallMoments moments = ball_moments(candidates, ball);
  if (moments.n < static_cast<double>(kLeastBallPoints)) return;
  const SymmetricMatrix<double> covariance = moments.covariance();
  const bool reject_early = task_.settings.switches.early_rejection;
  if (reject_early && chord_deviation_bound(eigenvalues_of(covariance), moments.n, thresholds.radius) < thresholds.cf1) return;
  const PrincipalFrame frame = principal_frame(covariance);
  if (reject_early) {
    const double extent = extent_bound(candidates, ball, frame.e3);
    if (chord_deviation_bound(frame.values, moments.n, thresholds.radius, extent) < thresholds.cf1) return;
  }
  const std::size_t n = ball_members(candidates, ball, fold_.candidates);
  fold_.members.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t c = fold_.candidates[i];
    const T dx = candidates.x[c] - ball.x;
    const T dy = candidates.y[c] - ball.y;
    const T dz = candidates.z[c] - ball.z;
    const std::uint32_t member = candidates.slot[c];
    fold_.members[i] = {static_cast<double>(dx), static_cast<double>(dy), static_cast<double>(dz),
                        static_cast<double>(dx * dx + dy * dy + dz * dz), tree.id(member), member};
  }
  evaluate_fold(frame, thresholds, fold_, emission_);
  const bool own_only = task_.settings.parameters.emit == LiuParameters::Emit::kSelf;
  for (const std::uint32_t emitted : emission_.slots) {
    if (!own_only || emitted == slot) task_.results.add_fold(emitted, emission_.strength, emission_.angle_deg);
  }
}

}  // namespace arris
