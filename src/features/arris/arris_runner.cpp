#include "features/arris/arris_runner.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/columns.h"
#include "features/contour/contour_finish.h"

namespace arris {
namespace {

/// Neighbours that the local spacing is taken from.
constexpr std::size_t kSpacingNeighbours = SpacingBatch<std::int32_t>::kNeighbours;

/// Larger balls of up to this many mean spacings of a group share their candidates.
constexpr double kCommonSpacing = 1.2;

/// What the shape of a point's first ball says before any point of it is looked at; false: it is no contour point.
bool may_be_contour(const BallShape& whole, PointProspects& prospects) {
  if (whole.count < kLeastBallMembers || whole.count > kMostBallPoints) return false;
  prospects = {};
  prospects.rms = whole.rms;
  prospects.near_rms = whole.rms;
  prospects.off_centre = whole.off_centre;
  prospects.fold = whole.rms >= kFlatRms;
  return prospects.fold || whole.off_centre >= kCentredShare;
}

/// The same of the near ball, where the first is not flat.
bool may_be_contour_near(const BallShape& near, PointProspects& prospects) {
  prospects.near_rms = near.rms;
  const bool flat = near.count >= kLeastBallMembers && near.rms < kNearFlatRms && near.middle_rms > kLeastNearWidth;
  if (!flat) return true;
  prospects.fold = false;
  prospects.rms = near.rms;
  return near.off_centre >= kNearCentredShare;
}

}  // namespace

/// The balls around one point: the first one is there, larger ones come on demand.
class ArrisRunner::Balls : public BallProvider {
 public:
  Balls(ArrisRunner& runner, const Ball& centre, double spacing, const BallPoints& first)
      : runner_(runner), centre_(centre), spacing_(spacing), first_(first) {}

  const BallPoints* ball(int level) override {
    if (level == 0) return &first_;
    BallPoints& points = runner_.points_[level - 1];
    if (known_[level - 1]) return &points;
    const double radius = std::min(kBallRadii[level] * spacing_, runner_.task_.max_reach);
    if (!runner_.seen(centre_.slot, radius)) return nullptr;
    SharedBalls& balls = level == 1 ? runner_.second_balls_ : runner_.third_balls_;
    balls.run({centre_.slot, radius, 0},
              [&](const auto& candidates, const auto& query) { collect_ball(candidates, query, spacing_, points); });
    known_[level - 1] = true;
    return &points;
  }

 private:
  ArrisRunner& runner_;
  const Ball& centre_;
  double spacing_;
  const BallPoints& first_;
  bool known_[2] = {false, false};
};

ArrisRunner::ArrisRunner(const ArrisTask& task)
    : task_(task),
      neighbour_search_(task.tree, {kSpacingNeighbours, task.max_reach, task.max_d2, Arithmetic::kFloat}),
      ball_search_(task.tree, Arithmetic::kFloat, BallSearch::Exact::kSums),
      second_balls_(task.tree),
      third_balls_(task.tree) {}

void ArrisRunner::run(std::span<const std::uint32_t> slots) {
  balls_.clear();
  spacings_.clear();
  neighbour_search_.run(slots, [this](std::uint32_t slot, const DistanceRow& row) { use_distances(slot, row); });
  use_spacings(narrow_);
  use_spacings(wide_);
  if (balls_.empty()) return;
  const double sum = std::accumulate(spacings_.begin(), spacings_.end(), 0.0);
  const double common = kCommonSpacing * sum / static_cast<double>(spacings_.size());
  second_balls_.begin(balls_, std::min(kBallRadii[1] * common, task_.max_reach));
  third_balls_.begin(balls_, std::min(kBallRadii[2] * common, task_.max_reach));
  ball_search_.run_groups(balls_, [this](const auto& candidates, const auto& queries, std::span<const Ball> balls) {
    test_group(candidates, queries, balls);
  });
}

/// True if every point within `reach` steps is in the tree.
bool ArrisRunner::seen(std::uint32_t slot, double reach) const {
  const std::int64_t depth =
      std::min<std::int64_t>(task_.covered.depth(task_.tree.position(slot)), std::int64_t{1} << 31);
  return std::min(reach, task_.max_reach) < static_cast<double>(depth);
}

void ArrisRunner::leave_unproven(std::uint32_t slot, double reach) {
  const double rounded = std::min(std::floor(reach), std::ceil(task_.max_reach)) + 1.0;
  unproven_.push_back({task_.tree.id(slot), task_.tree.position(slot), static_cast<std::int64_t>(rounded)});
}

void ArrisRunner::use_distances(std::uint32_t slot, const DistanceRow& row) {
  if (row.count < kSpacingNeighbours) {
    if (seen(slot, task_.max_reach)) {
      isolated_.push_back(slot);
    } else {
      leave_unproven(slot, task_.max_reach);
    }
  } else if (row.narrow) {
    wait_for_spacing(narrow_, slot, row.narrow_d2);
  } else {
    wait_for_spacing(wide_, slot, row.wide_d2);
  }
}

template <class Key>
void ArrisRunner::wait_for_spacing(Waiting<Key>& waiting, std::uint32_t slot, const DistanceRow::Keys<Key>& row) {
  waiting.slots[waiting.count] = slot;
  waiting.batch.set(waiting.count++, row);
  if (waiting.count == waiting.slots.size()) use_spacings(waiting);
}

template <class Key>
void ArrisRunner::use_spacings(Waiting<Key>& waiting) {
  if (waiting.count == 0) return;
  waiting.batch.solve();
  for (std::size_t i = 0; i < waiting.count; ++i) {
    use_spacing(waiting.slots[i], waiting.batch.density(i), static_cast<double>(waiting.batch.last_d2(i)));
  }
  waiting.count = 0;
}

void ArrisRunner::use_spacing(std::uint32_t slot, double density, double last_d2) {
  const double spacing = task_.parameters.spacing > 0.0 ? task_.parameters.spacing / task_.lattice.step : density;
  const double last = std::sqrt(last_d2);
  // Unseen points can only bring the last neighbour closer and so make all balls smaller.
  const double widest = std::max(last, std::min(kBallRadii[2] * spacing, task_.max_reach));
  const double radius = std::min(kBallRadii[0] * spacing, task_.max_reach);
  if (!seen(slot, std::max(last, radius))) {
    leave_unproven(slot, widest);
    return;
  }
  balls_.push_back({slot, radius, static_cast<std::uint32_t>(spacings_.size())});
  spacings_.push_back(spacing);
}

/// First what moments tell, of all balls together; then what is left, one by one.
template <class T>
void ArrisRunner::test_group(const CandidateSet<T>& candidates, std::span<const BallQuery<T>> queries,
                             std::span<const Ball> balls) {
  measures_.clear();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    measures_.push_back({ball_moments(candidates, queries[i]), balls[i].radius, spacings_[balls[i].query]});
  }
  shapes_.resize(balls.size());
  measure_shapes(measures_, shapes_);
  measures_.clear();
  prospects_.resize(balls.size());
  left_.clear();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!may_be_contour(shapes_[i], prospects_[i])) continue;
    left_.push_back(i);
    if (!prospects_[i].fold) continue;
    BallQuery<T> near = queries[i];
    const double radius = balls[i].radius * (kNearRadius / kBallRadii[0]);
    near.radius2 = static_cast<T>(static_cast<std::uint64_t>(radius * radius));
    measures_.push_back({ball_moments(candidates, near), radius, spacings_[balls[i].query]});
  }
  shapes_.resize(measures_.size());
  measure_shapes(measures_, shapes_);
  std::size_t near = 0;
  std::erase_if(
      left_, [&](std::size_t i) { return prospects_[i].fold && !may_be_contour_near(shapes_[near++], prospects_[i]); });
  for (std::span<const std::size_t> left(left_); !left.empty();) {
    const std::size_t count = std::min(left.size(), std::size(first_points_));
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = left[k];
      collect_ball(candidates, queries[i], spacings_[balls[i].query], first_points_[k]);
    }
    look_for_scatter(left.first(count));
    for (std::size_t k = 0; k < count; ++k) test(balls[left[k]], prospects_[left[k]], first_points_[k]);
    left = left.subspan(count);
  }
}

/// Settles whether the points of the first balls scatter. `indices`: of the balls, in the order of first_points_.
void ArrisRunner::look_for_scatter(std::span<const std::size_t> indices) {
  if (!task_.parameters.fold) return;
  const BallPoints* asked[std::size(first_points_)];
  PointProspects* prospects[std::size(first_points_)];
  std::uint8_t scatters[std::size(first_points_)];
  std::size_t n = 0;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    PointProspects& p = prospects_[indices[k]];
    if (!may_scatter(p)) continue;
    asked[n] = &first_points_[k];
    prospects[n++] = &p;
  }
  find_scatter(std::span(asked, n), scatter_scratch_, std::span(scatters, n));
  for (std::size_t k = 0; k < n; ++k) prospects[k]->scatter = scatters[k] != 0;
}

void ArrisRunner::test(const Ball& ball, const PointProspects& prospects, const BallPoints& first) {
  const double spacing = spacings_[ball.query];
  Balls balls(*this, ball, spacing, first);
  PointContour contour;
  if (!analyse_point(prospects, balls, scratch_, task_.parameters.fold, task_.parameters.boundary, contour)) {
    leave_unproven(ball.slot, std::min(kBallRadii[2] * spacing, task_.max_reach));
    return;
  }
  if (contour.kind == PointContour::Kind::kNone || contour.score < task_.parameters.min_score) return;
  if (task_.parameters.thin && !leads_chain(first, contour)) return;
  record(ball, contour);
}

std::uint8_t ArrisRunner::side_of(std::uint32_t slot, const FoldLine& line) const {
  using View = ArrisParameters::View;
  if (task_.parameters.view == View::kNone) return 0;
  if (task_.parameters.view == View::kAbove) return fold_side(line, {0.0, 0.0, 1.0});
  const LatticePoint p = task_.tree.position(slot);
  Vector3 view;
  for (int axis = 0; axis < 3; ++axis) {
    view[axis] = task_.parameters.viewpoint[axis] - task_.lattice.world(axis, p[axis]);
  }
  return fold_side(line, view);
}

void ArrisRunner::record(const Ball& ball, const PointContour& contour) {
  const double spacing = spacings_[ball.query] * task_.lattice.step;
  ContourRecord record;
  record.id = task_.tree.id(ball.slot);
  record.score = static_cast<float>(contour.score);
  for (int axis = 0; axis < 3; ++axis) record.to_edge[axis] = static_cast<float>(contour.nearest[axis] * spacing);
  if (contour.kind == PointContour::Kind::kFold) {
    record.classes = static_cast<std::uint8_t>(kFold | side_of(ball.slot, contour.line));
    record.fold_angle_deg = static_cast<float>(contour.line.angle_deg);
    record.fold_strength = 1.0F;
  } else {
    record.classes = kBoundary;
    record.gap_deg = static_cast<float>(contour.gap_deg);
  }
  found_.push_back({ball.slot, record});
}

}  // namespace arris
