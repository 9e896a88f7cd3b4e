#include "features/arris/arris_runner.h"

#include <algorithm>
#include <cmath>

#include "core/columns.h"
#include "features/contour/contour_finish.h"
#include "features/neighbourhood/local_spacing.h"

namespace arris {
namespace {

/// Neighbours that the local spacing is taken from.
constexpr std::size_t kSpacingNeighbours = 20;

/// Larger balls of up to this many median spacings of a group share their candidates.
constexpr double kCommonSpacing = 1.2;

struct BallShape {
  double count = 0.0;
  double rms = 0.0;         ///< About the plane, spacings.
  double middle_rms = 0.0;  ///< Spread along the shorter direction of the plane.
  double off_centre = 0.0;  ///< Distance of the mean from the centre, radii.
};

BallShape shape_of(const BallMoments& m, double radius, double spacing) {
  BallShape shape;
  shape.count = m.n;
  const Eigenvalues<double> values = eigenvalues_of(m.covariance());
  shape.rms = std::sqrt(std::max(values.smallest, 0.0)) / spacing;
  shape.middle_rms = std::sqrt(std::max(values.middle, 0.0)) / spacing;
  shape.off_centre = std::sqrt(m.x * m.x + m.y * m.y + m.z * m.z) / (m.n * radius);
  return shape;
}

}  // namespace

/// The balls around one point: the first from the candidates of its group, larger ones on demand.
class ArrisRunner::Balls : public BallProvider {
 public:
  Balls(ArrisRunner& runner, const Ball& centre, double spacing)
      : runner_(runner), centre_(centre), spacing_(spacing) {}

  template <class T>
  void collect_first(const CandidateSet<T>& candidates, const BallQuery<T>& query) {
    collect_ball(candidates, query, spacing_, runner_.points_[0]);
    known_[0] = true;
  }

  const BallPoints* ball(int level) override {
    if (known_[level]) return &runner_.points_[level];
    const double radius = std::min(kBallRadii[level] * spacing_, runner_.task_.max_reach);
    if (!runner_.seen(centre_.slot, radius)) return nullptr;
    SharedBalls& balls = level == 1 ? runner_.second_balls_ : runner_.third_balls_;
    balls.run({centre_.slot, radius, 0}, [&](const auto& candidates, const auto& query) {
      collect_ball(candidates, query, spacing_, runner_.points_[level]);
    });
    known_[level] = true;
    return &runner_.points_[level];
  }

 private:
  ArrisRunner& runner_;
  const Ball& centre_;
  double spacing_;
  bool known_[3] = {false, false, false};
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
  neighbour_search_.run(slots,
                        [this](std::uint32_t slot, const Neighbours& neighbours) { use_neighbours(slot, neighbours); });
  if (balls_.empty()) return;
  std::vector<double>& sorted = sorted_spacings_;
  sorted.assign(spacings_.begin(), spacings_.end());
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double common = kCommonSpacing * sorted[sorted.size() / 2];
  second_balls_.begin(balls_, std::min(kBallRadii[1] * common, task_.max_reach));
  third_balls_.begin(balls_, std::min(kBallRadii[2] * common, task_.max_reach));
  ball_search_.run(
      balls_, [this](const auto& candidates, const auto& query, const Ball& ball) { test(candidates, query, ball); });
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

void ArrisRunner::use_neighbours(std::uint32_t slot, const Neighbours& neighbours) {
  if (neighbours.count < kSpacingNeighbours) {
    if (seen(slot, task_.max_reach)) {
      isolated_.push_back(slot);
    } else {
      leave_unproven(slot, task_.max_reach);
    }
    return;
  }
  const double spacing = task_.parameters.spacing > 0.0 ? task_.parameters.spacing / task_.lattice.step
                                                        : local_spacing(neighbours).density;
  const double last = std::sqrt(static_cast<double>(neighbours.last_d2));
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

template <class T>
void ArrisRunner::test(const CandidateSet<T>& candidates, const BallQuery<T>& query, const Ball& ball) {
  const double spacing = spacings_[ball.query];
  const BallShape whole = shape_of(ball_moments(candidates, query), ball.radius, spacing);
  if (whole.count < kLeastBallMembers || whole.count > kMostBallPoints) return;
  PointProspects prospects;
  prospects.rms = whole.rms;
  prospects.near_rms = whole.rms;
  prospects.off_centre = whole.off_centre;
  if (whole.rms < kFlatRms) {
    if (whole.off_centre < kCentredShare) return;
    prospects.fold = false;
  } else {
    BallQuery<T> near = query;
    const double near_radius = ball.radius * (kNearRadius / kBallRadii[0]);
    near.radius2 = static_cast<T>(static_cast<std::uint64_t>(near_radius * near_radius));
    const BallShape close = shape_of(ball_moments(candidates, near), near_radius, spacing);
    prospects.near_rms = close.rms;
    if (close.count >= kLeastBallMembers && close.rms < kNearFlatRms && close.middle_rms > kLeastNearWidth) {
      if (close.off_centre < kNearCentredShare) return;
      prospects.fold = false;
      prospects.rms = close.rms;
    }
  }
  Balls balls(*this, ball, spacing);
  balls.collect_first(candidates, query);
  PointContour contour;
  if (!analyse_point(prospects, balls, scratch_, task_.parameters.fold, task_.parameters.boundary, contour)) {
    leave_unproven(ball.slot, std::min(kBallRadii[2] * spacing, task_.max_reach));
    return;
  }
  if (contour.kind == PointContour::Kind::kNone || contour.score < task_.parameters.min_score) return;
  if (task_.parameters.thin && !leads_chain(points_[0], contour)) return;
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
