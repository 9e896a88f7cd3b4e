#include "features/liu_runner.h"

#include <algorithm>
#include <cmath>

#include "features/exact_math.h"

namespace arris {
namespace {

/// The first reach is guessed this much above the mean need of the group before: most queries then need no second
/// gathering, and candidates stay few.
constexpr double kReachMargin = 1.25;
constexpr double kReachGrowth = 1.4;
/// Balls up to this much larger than the median of their group share its candidates.
constexpr double kBallSpread = 1.3;

std::uint32_t slot_of(std::uint32_t slot) {
  return slot;
}
std::uint32_t slot_of(const LiuBall& ball) {
  return ball.slot;
}

/// Box around queries: slots, or anything else that slot_of knows.
template <class Query>
ClosedBox box_of(const PointTree& tree, std::span<const Query> queries) {
  const LatticePoint first = tree.position(slot_of(queries[0]));
  ClosedBox box{{first.x, first.y, first.z}, {first.x, first.y, first.z}};
  for (const Query& query : queries) {
    const LatticePoint p = tree.position(slot_of(query));
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
  double reach = first_reach(slots);
  reach_sum_ = 0.0;
  measured_ = 0;
  pending_.clear();
  balls_.clear();
  run_neighbours(slots, reach);
  while (!pending_.empty()) {
    reach = std::min(kReachGrowth * reach + 1.0, task_.settings.max_reach);
    const std::vector<std::uint32_t> again = std::move(pending_);
    pending_.clear();
    run_neighbours(again, reach);
  }
  // Balls of one size together; the few large ones would only burden the others.
  std::sort(balls_.begin(), balls_.end(), [](const LiuBall& a, const LiuBall& b) {
    return a.thresholds.radius != b.thresholds.radius ? a.thresholds.radius < b.thresholds.radius : a.slot < b.slot;
  });
  for (std::span<const LiuBall> left(balls_); !left.empty();) {
    const double most = kBallSpread * left[left.size() / 2].thresholds.radius;
    std::size_t take = left.size();
    while (left[take - 1].thresholds.radius > most) --take;
    run_balls(left.first(take));
    left = left.subspan(take);
  }
}

double LiuRunner::first_reach(std::span<const std::uint32_t> slots) const {
  double reach = 0.0;
  if (measured_ > 0) {
    reach = kReachMargin * reach_sum_ / static_cast<double>(measured_);
  } else {
    // As if the points lay on a plane that the two longest sides of their box span.
    const ClosedBox box = box_of<std::uint32_t>(task_.tree, slots);
    double sides[3];
    for (int axis = 0; axis < 3; ++axis) sides[axis] = static_cast<double>(box.max[axis]) - box.min[axis] + 1.0;
    std::sort(std::begin(sides), std::end(sides));
    const double points = static_cast<double>(slots.size());
    reach = 1.5 * std::sqrt(sides[1] * sides[2] / points * task_.settings.parameters.k_max / kPi);
  }
  return std::min(std::max(reach, 2.0), task_.settings.max_reach);
}

void LiuRunner::run_neighbours(std::span<const std::uint32_t> slots, double reach) {
  const auto narrowest = task_.settings.switches.narrowest;
  using Narrowest = LiuSwitches::Arithmetic;
  if (narrowest <= Narrowest::kFloat && try_neighbours(floats_, slots, reach)) return;
  if (narrowest <= Narrowest::kDouble && try_neighbours(doubles_, slots, reach)) return;
  try_neighbours(integers_, slots, reach);
}

template <class T>
bool LiuRunner::try_neighbours(Arithmetic<T>& arithmetic, std::span<const std::uint32_t> slots, double reach) {
  if ((reach + 1.0) * (reach + 1.0) >= kExactSquares<T>) return false;
  if (!arithmetic.candidates.gather(task_.tree, box_of<std::uint32_t>(task_.tree, slots), reach)) return false;
  arithmetic.guess_d2 = squared_limit<T>(reach / kReachMargin, task_.settings.max_d2);
  for (const std::uint32_t slot : slots) {
    if (find_neighbours(arithmetic, slot, reach)) {
      use_neighbours(slot);
    } else {
      pending_.push_back(slot);
    }
  }
  return true;
}

/// False if neighbours may lie beyond the reach.
template <class T>
bool LiuRunner::find_neighbours(Arithmetic<T>& arithmetic, std::uint32_t slot, double reach) {
  const LiuSettings& settings = task_.settings;
  const CandidateSet<T>& candidates = arithmetic.candidates;
  const PointTree& tree = task_.tree;
  NearestQuery<T> query;
  query.x = static_cast<T>(tree.x()[slot] - candidates.origin[0]);
  query.y = static_cast<T>(tree.y()[slot] - candidates.origin[1]);
  query.z = static_cast<T>(tree.z()[slot] - candidates.origin[2]);
  query.k = static_cast<std::size_t>(settings.parameters.k_max);
  query.max_d2 = squared_limit<T>(reach, settings.max_d2);
  query.guess_d2 = arithmetic.guess_d2;
  select_nearest(tree, candidates, query, arithmetic.nearest, neighbours_);
  if (neighbours_.count < query.k) return static_cast<std::uint64_t>(query.max_d2) == settings.max_d2;
  arithmetic.guess_d2 = static_cast<T>(1.1 * static_cast<double>(neighbours_.last_d2) + 1.0);
  return true;
}

void LiuRunner::use_neighbours(std::uint32_t slot) {
  const LiuParameters& parameters = task_.settings.parameters;
  reach_sum_ += std::sqrt(static_cast<double>(neighbours_.last_d2));
  ++measured_;
  const LocalSpacing spacing = task_.settings.spacing(neighbours_);
  const FoldThresholds fold = task_.settings.fold_thresholds(spacing);
  if (!proven(slot, fold)) return;
  if (neighbours_.count < static_cast<std::size_t>(parameters.k_min)) {
    task_.results.add_isolated(slot);
    return;
  }
  if (parameters.boundary) test_boundary(slot, spacing);
  if (parameters.fold) balls_.push_back({slot, fold});
}

bool LiuRunner::proven(std::uint32_t slot, const FoldThresholds& fold) {
  const LiuSettings& settings = task_.settings;
  const LatticePoint position = task_.tree.position(slot);
  const auto depth =
      static_cast<std::uint64_t>(std::min<std::int64_t>(task_.covered.depth(position), std::int64_t{1} << 31));
  const std::uint64_t seen_d2 = depth * depth;  // Every lattice position nearer than this is covered.
  if (settings.max_d2 < seen_d2) return true;
  const bool full = neighbours_.count == static_cast<std::size_t>(settings.parameters.k_max);
  if (full && neighbours_.last_d2 < seen_d2 &&
      (!settings.parameters.fold || fold.radius * fold.radius < static_cast<double>(seen_d2))) {
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

void LiuRunner::test_boundary(std::uint32_t slot, const LocalSpacing& spacing) {
  const ScaleChoice choice = choose_scale(neighbours_, task_.settings.scale);
  if (choice.k == 0) return;
  const PrincipalFrame frame = principal_frame(choice.covariance, choice.values);
  GapQuery query;
  query.u = frame.e1;
  query.v = frame.e2;
  query.count = static_cast<std::size_t>(choice.k);
  const double far = task_.settings.far_distance(spacing);
  const auto end = neighbours_.d2.begin() + choice.k;
  query.near_count =
      static_cast<std::size_t>(std::upper_bound(neighbours_.d2.begin(), end, far * far) - neighbours_.d2.begin());
  query.min_offset = 1e-6 * spacing.nearest;
  const AzimuthGapTest& test = task_.settings.gap_test;
  task_.results.add_gap(slot, task_.settings.switches.early_rejection
                                  ? test(neighbours_, query, azimuths_)
                                  : test.without_rejection(neighbours_, query, azimuths_));
}

void LiuRunner::run_balls(std::span<const LiuBall> balls) {
  const auto narrowest = task_.settings.switches.narrowest;
  using Narrowest = LiuSwitches::Arithmetic;
  if (narrowest <= Narrowest::kFloat && try_balls(floats_, balls)) return;
  if (narrowest <= Narrowest::kDouble && try_balls(doubles_, balls)) return;
  try_balls(integers_, balls);
}

/// Balls in ascending order of their radii.
template <class T>
bool LiuRunner::try_balls(Arithmetic<T>& arithmetic, std::span<const LiuBall> balls) {
  const double reach = balls.back().thresholds.radius;
  if ((reach + 1.0) * (reach + 1.0) >= kExactSquares<T>) return false;
  if (!arithmetic.candidates.gather(task_.tree, box_of<LiuBall>(task_.tree, balls), reach)) return false;
  if (!ball_sums_are_exact<T>(reach, arithmetic.candidates.count)) return false;
  for (const LiuBall& ball : balls) test_fold(arithmetic.candidates, ball);
  return true;
}

template <class T>
void LiuRunner::test_fold(const CandidateSet<T>& candidates, const LiuBall& query) {
  const PointTree& tree = task_.tree;
  const auto& [slot, thresholds] = query;
  const double radius = thresholds.radius;
  BallQuery<T> ball;
  ball.x = static_cast<T>(tree.x()[slot] - candidates.origin[0]);
  ball.y = static_cast<T>(tree.y()[slot] - candidates.origin[1]);
  ball.z = static_cast<T>(tree.z()[slot] - candidates.origin[2]);
  ball.radius2 = static_cast<T>(static_cast<std::uint64_t>(radius * radius));
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
    if (!own_only || emitted == slot) task_.results.add_fold(emitted, emission_.strength, emission_.angle_deg);
  }
}

}  // namespace arris
