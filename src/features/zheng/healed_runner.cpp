#include "features/zheng/healed_runner.h"

#include <algorithm>
#include <cmath>

#include "core/columns.h"
#include "features/zheng/mutual_nearest.h"
#include "features/zheng/supervoxel_pair.h"

namespace arris {
namespace {

/// Parallel supervoxels are steps, and not one surface, if they are offset by more spacings, or by more thicknesses.
constexpr double kStepSpacings = 2.0;
constexpr double kStepThicknesses = 2.0;
/// Clustering mixes the two sides of a fold, which lessens the angle between the normals: this share of T proposes.
constexpr double kProposingShare = 0.4;
/// A supervoxel that is thicker, spacings, than noise makes it may hold a fold within.
constexpr double kThickSpacings = 0.4;
/// Where points are denser than `spacing` says, smaller balls do: shares of the ball's radius, ascending.
constexpr double kBallShares[] = {0.25, 0.5, 1.0};
/// The share that is tried first is at least this many times the supervoxel's spacing over the length it counts with:
/// the spacing of strings of points, and of supervoxels that hold a fold, is too small.
constexpr double kShareMargin = 1.25;
/// Balls of less than the full radius must hold this many points; a ball of 5 spacings holds 78 on a surface.
constexpr double kEnoughMembers = 100.0;

}  // namespace

/// The balls around one point: the first from the candidates of its group, the second on demand.
class HealedRunner::Balls : public BallProvider {
 public:
  Balls(HealedRunner& runner, const Ball& centre, double wide, double spacing)
      : runner_(runner), centre_(centre), wide_(wide), spacing_(spacing) {}

  template <class T>
  void collect_first(const CandidateSet<T>& candidates, const BallQuery<T>& query) {
    collect_ball(candidates, query, spacing_, runner_.points_[0]);
  }

  const BallPoints* ball(int level) override {
    BallPoints& points = runner_.points_[level];
    if (level == 0 || known_) return &points;
    runner_.wide_balls_.run({centre_.slot, wide_, 0}, [&](const auto& candidates, const auto& query) {
      collect_ball(candidates, query, spacing_, points);
    });
    known_ = true;
    return &points;
  }

 private:
  HealedRunner& runner_;
  const Ball& centre_;
  double wide_;  ///< Steps.
  double spacing_;
  bool known_ = false;
};

HealedRunner::HealedRunner(const ZhengTask& task)
    : task_(task), ball_search_(task.tree, Arithmetic::kFloat, BallSearch::Exact::kSums), wide_balls_(task.tree) {}

void HealedRunner::run(std::span<const std::uint32_t> slots) {
  queries_.clear();
  for (const std::uint32_t slot : slots) {
    if (task_.labels[slot] != 0) queries_.push_back({task_.labels[slot], slot});
  }
  if (queries_.empty()) return;
  const ClosedBox box =
      detail::box_of(task_.tree, std::span<const Query>(queries_), [](const Query& query) { return query.slot; });
  std::sort(queries_.begin(), queries_.end(),
            [](const Query& a, const Query& b) { return a.label != b.label ? a.label < b.label : a.slot < b.slot; });
  double reach = 0.0;
  for (const Query& query : queries_) {
    const ZhengLengths lengths = task_.settings.lengths(task_.table, query.label);
    reach = std::max({reach, 2.0 * lengths.alpha, lengths.cap});
  }
  group_.gather(task_.tree, task_.labels, box, reach);
  proposals_.clear();
  for (std::size_t begin = 0; begin < queries_.size();) {
    std::size_t end = begin + 1;
    while (end < queries_.size() && queries_[end].label == queries_[begin].label) ++end;
    propose(std::span<const Query>(queries_).subspan(begin, end - begin), *group_.part(queries_[begin].label), box);
    begin = end;
  }
  judge_all();
}

/// The smallest balls first; those that hold too few points are asked for again, twice as large.
void HealedRunner::judge_all() {
  for (const double share : kBallShares) {
    balls_.clear();
    double largest = 0.0;
    for (std::uint32_t i = 0; i < proposals_.size(); ++i) {
      Proposal& proposal = proposals_[i];
      if (proposal.judged || share < proposal.least_share) continue;
      proposal.share = share;
      balls_.push_back({proposal.slot, kJudgedBall * share * proposal.spacing, i});
      largest = std::max(largest, share * proposal.spacing);
    }
    if (balls_.empty()) continue;
    wide_balls_.begin(balls_, std::min(kWideBall * largest, kLargestJudgedBall * task_.settings.typical.spacing));
    ball_search_.run(balls_, [this](const auto& candidates, const auto& query, const Ball& ball) {
      judge(candidates, query, ball);
    });
  }
}

HealedRunner::Beside HealedRunner::beside(const LabelledPart& own, const LabelledPart& other,
                                          const ZhengLengths& lengths) const {
  const SupervoxelTable& table = task_.table;
  const double angle_deg = normal_angle_deg(table, own.label, other.label);
  const double thickness = static_cast<double>(table.thickness[own.label]) + table.thickness[other.label];
  const double most_step = std::max(kStepSpacings * lengths.spacing, kStepThicknesses * thickness);
  const double most_angle = task_.settings.parameters.angle_deg;
  return {&other, angle_deg <= most_angle && step_height(table, own.label, other.label) <= most_step,
          angle_deg > kProposingShare * most_angle};
}

void HealedRunner::propose(std::span<const Query> run, const LabelledPart& own, const ClosedBox& box) {
  const ZhengParameters& parameters = task_.settings.parameters;
  const ZhengLengths lengths = task_.settings.lengths(task_.table, own.label);
  const SupervoxelFrame frame = supervoxel_frame(task_.table, own.label);
  if (frame.defined) {
    surface_.begin(frame);
    surface_.add(group_, own);
  }
  beside_.clear();
  for (const LabelledPart& other : group_.parts()) {
    if (other.label == own.label || !task_.table.adjacent(own.label, other.label)) continue;
    beside_.push_back(beside(own, other, lengths));
    if (frame.defined && beside_.back().continues) surface_.add(group_, other);
  }
  if (frame.defined) surface_.expect(box);
  const bool thick = task_.table.thickness[own.label] > kThickSpacings * lengths.spacing;
  const double least_share = std::min(kShareMargin * task_.table.spacing[own.label] / lengths.spacing, 1.0);
  for (const Query& query : run) {
    const Vector3 at = group_.relative(task_.tree, query.slot);
    Proposal proposal;
    proposal.slot = query.slot;
    proposal.spacing = lengths.spacing;
    proposal.least_share = least_share;
    proposal.bent = thick && parameters.fold;
    if (parameters.fold) {
      for (const Beside& b : beside_) {
        if (!b.bends || (proposal.bent && b.continues)) continue;
        const bool near = any_within(group_, *b.part, at, lengths.cap * lengths.cap);
        proposal.bent |= near;
        proposal.contact |= near && !b.continues;
      }
    }
    if (parameters.boundary) {
      proposal.border = !frame.defined || surface_.exposure_deg(at, lengths.alpha) > 0.0;
    }
    if (proposal.bent || proposal.border) proposals_.push_back(proposal);
  }
}

template <class T>
void HealedRunner::judge(const CandidateSet<T>& candidates, const BallQuery<T>& query, const Ball& ball) {
  Proposal& proposal = proposals_[ball.query];
  const BallMoments moments = ball_moments(candidates, query);
  if (proposal.share < 1.0 && moments.n < kEnoughMembers) return;  // The next larger ball will be asked for.
  proposal.judged = true;
  const double spacing = proposal.share * proposal.spacing;
  if (moments.n < kLeastBallMembers || moments.n > kMostBallPoints) return;
  SeamQuestion question;
  question.fold = proposal.bent;
  question.border = proposal.border;
  question.least_turn_deg = task_.settings.parameters.angle_deg;
  question.rms = std::sqrt(std::max(eigenvalues_of(moments.covariance()).smallest, 0.0)) / spacing;
  if (!question.border && question.rms < kFlatRms) return;
  const double wide = std::min(kWideBall * spacing, kLargestJudgedBall * task_.settings.typical.spacing);
  question.radius[0] = kJudgedBall;
  question.radius[1] = wide / spacing;
  Balls balls(*this, ball, wide, spacing);
  balls.collect_first(candidates, query);
  const PointContour contour = judge_seam(question, balls, scratch_);
  if (contour.kind != PointContour::Kind::kNone) record(ball.slot, proposal, contour);
}

void HealedRunner::record(std::uint32_t slot, const Proposal& proposal, const PointContour& contour) {
  const double unit = proposal.share * proposal.spacing * task_.settings.step;
  ContourRecord record;
  record.id = task_.tree.id(slot);
  record.score = static_cast<float>(contour.score);
  for (std::size_t axis = 0; axis < 3; ++axis) record.to_edge[axis] = static_cast<float>(contour.nearest[axis] * unit);
  if (contour.kind == PointContour::Kind::kFold) {
    record.classes = static_cast<std::uint8_t>(kFold | (proposal.contact ? kSupervoxelContact : 0));
    record.votes = 1;
    record.fold_strength = static_cast<float>((180.0 - contour.line.angle_deg) / task_.settings.parameters.angle_deg);
    record.fold_angle_deg = static_cast<float>(contour.line.angle_deg);
  } else {
    record.classes = kBoundary;
    record.gap_deg = static_cast<float>(contour.gap_deg);
  }
  found_.push_back({slot, record});
}

}  // namespace arris
