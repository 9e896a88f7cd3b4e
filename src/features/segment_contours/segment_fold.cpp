#include "features/segment_contours/segment_fold.h"

#include <algorithm>
#include <cmath>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

/// So many points on either side are full support.
constexpr double kFullSupport = 3.0;
/// A segment that has more than this share of its larger side's points on the smaller one goes on beyond the line.
constexpr double kThroughShare = 0.25;

/// Points of a segment around a place on the line, by the side of the other plane that they are on.
struct Sides {
  int above = 0, below = 0;

  int count() const { return above + below; }
  bool through() const { return std::min(above, below) > kThroughShare * std::max(above, below); }
  double sign() const { return above >= below ? 1.0 : -1.0; }
};

/// @param at, place  relative to the group's origin, exact, and relative to `at`.
Sides count_sides(const SegmentTask& task, const LabelledGroup& group, const LabelledPart& part, std::uint32_t other,
                  const Vector3& at, const Vector3& place, double radius) {
  Sides sides;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const Vector3 p = group.at(i);
    const Vector3 d{(p[0] - at[0]) - place[0], (p[1] - at[1]) - place[1], (p[2] - at[2]) - place[2]};
    if (dot(d, d) > radius * radius) continue;
    ++(task.distance(other, group.slot(i)) >= 0.0 ? sides.above : sides.below);
  }
  return sides;
}

/// The half planes that start at the line and hold the points; of a segment that goes on beyond the line the half that
/// makes the smaller angle.
FoldLine line_between(const SegmentTask& task, const PlaneMeeting& meeting, const Sides& own, const Sides& other) {
  const Vector3& n = task.plane(meeting.own).normal;
  const Vector3& m = task.plane(meeting.other).normal;
  double own_sign = own.sign();
  double other_sign = other.sign();
  // The cosine of the angle between the halves is -own_sign * other_sign * cosine.
  const double acute = meeting.cosine > 0.0 ? -1.0 : 1.0;
  if (other.through()) {
    other_sign = acute * own_sign;
  } else if (own.through()) {
    own_sign = acute * other_sign;
  }
  FoldLine line;
  const double cosine = -own_sign * other_sign * meeting.cosine;
  line.angle_deg = arc_cosine(cosine) * kDegreesPerRadian;
  const double sine = std::sqrt(meeting.sine2);
  line.direction = cross(n, m);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    line.direction[axis] /= sine;
    line.opening[axis] = own_sign * (m[axis] - meeting.cosine * n[axis]) / sine +
                         other_sign * (n[axis] - meeting.cosine * m[axis]) / sine;
  }
  const double length = std::sqrt(dot(line.opening, line.opening));
  for (double& c : line.opening) c /= length;  // Longer than the sine of fold_angle_deg: the halves never oppose.
  return line;
}

}  // namespace

PlaneMeeting plane_meeting(const SegmentTask& task, std::uint32_t own, std::uint32_t other) {
  const Vector3& n = task.plane(own).normal;
  const Vector3& m = task.plane(other).normal;
  const Vector3 across = cross(n, m);
  PlaneMeeting meeting{own, other, dot(n, m), dot(across, across), 0.0};
  meeting.angle_deg = angle_of(std::sqrt(meeting.sine2), std::fabs(meeting.cosine)) * kDegreesPerRadian;
  return meeting;
}

SegmentFold fold_at(const SegmentTask& task, const LabelledGroup& group, const PlaneMeeting& meeting,
                    std::uint32_t slot) {
  const SegmentLengths lengths = task.lengths(meeting.own);
  const double d = task.distance(meeting.own, slot);
  const double e = task.distance(meeting.other, slot);
  // The shortest way that ends on both planes is a combination of their normals.
  const double along_own = (meeting.cosine * e - d) / meeting.sine2;
  const double along_other = (meeting.cosine * d - e) / meeting.sine2;
  SegmentFold fold;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    fold.to_line[axis] =
        along_own * task.plane(meeting.own).normal[axis] + along_other * task.plane(meeting.other).normal[axis];
  }
  const double distance2 = dot(fold.to_line, fold.to_line);
  if (distance2 > lengths.explain * lengths.explain) return fold;
  const Vector3 at = group.relative(task.tree, slot);
  const double other_support = std::min(task.lengths(meeting.other).support, lengths.most_support);
  const Sides other =
      count_sides(task, group, *group.part(meeting.other), meeting.own, at, fold.to_line, other_support);
  if (other.count() == 0) return fold;
  const Sides own =
      count_sides(task, group, *group.part(meeting.own), meeting.other, at, fold.to_line, lengths.support);
  if (own.count() == 0) return fold;
  fold.explains = true;
  if (distance2 > lengths.line * lengths.line) return fold;
  const double near = 1.0 - 0.5 * distance2 / (lengths.line * lengths.line);
  const double sharp = std::min(1.0, meeting.angle_deg / (2.0 * task.parameters.fold_angle_deg));
  const double support = std::min(1.0, std::min(own.count(), other.count()) / kFullSupport);
  fold.score = near * sharp * support;
  fold.line = line_between(task, meeting, own, other);
  return fold;
}

}  // namespace arris
