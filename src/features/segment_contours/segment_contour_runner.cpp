#include "features/segment_contours/segment_contour_runner.h"

#include <algorithm>
#include <cmath>

#include "core/columns.h"
#include "features/contour/contour_finish.h"
#include "features/neighbourhood/group_box.h"
#include "features/numerics/exact_math.h"

namespace arris {

void SegmentContourRunner::run(std::span<const std::uint32_t> slots) {
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
  for (const Query& query : queries_) reach = std::max(reach, task_.lengths(query.label).reach);
  group_.gather(task_.tree, task_.labels, box, reach);
  for (std::size_t begin = 0; begin < queries_.size();) {
    std::size_t end = begin + 1;
    while (end < queries_.size() && queries_[end].label == queries_[begin].label) ++end;
    run_segment(std::span<const Query>(queries_).subspan(begin, end - begin), box);
    begin = end;
  }
}

void SegmentContourRunner::run_segment(std::span<const Query> run, const ClosedBox& box) {
  const std::uint32_t label = run[0].label;
  meetings_.clear();
  continue_.clear();
  for (const LabelledPart& part : group_.parts()) {
    if (part.label == label) continue;
    const PlaneMeeting meeting = plane_meeting(task_, label, part.label);
    if (meeting.angle_deg < task_.parameters.fold_angle_deg) {
      continue_.push_back(part.label);
    } else {
      meetings_.push_back(meeting);
    }
  }
  own_.begin(label, box);
  own_.add(*group_.part(label));
  joined_known_ = false;
  for (const Query& query : run) {
    const SegmentFold fold = task_.parameters.fold || task_.parameters.boundary ? best_fold(query.slot) : SegmentFold{};
    if (fold.score > 0.0 && task_.parameters.fold) found_.push_back({query.slot, fold_record(query.slot, fold)});
    if (std::fabs(task_.distance(label, query.slot)) > own_.lengths().slab) continue;
    const Vector3 at = group_.relative(task_.tree, query.slot);
    if (own_.surely_inside(at)) continue;
    if (task_.parameters.outlines) add_edges(query.slot);
    if (!task_.parameters.boundary || fold.explains) continue;
    const double free_deg = border_deg(at, box);
    if (free_deg > 0.0) found_.push_back({query.slot, border_record(query.slot, free_deg)});
  }
}

/// The highest score wins; of equals the smallest label, which comes first.
SegmentFold SegmentContourRunner::best_fold(std::uint32_t slot) const {
  SegmentFold best;
  for (const PlaneMeeting& meeting : meetings_) {
    const SegmentFold fold = fold_at(task_, group_, meeting, slot);
    const bool explains = best.explains || fold.explains;
    if (fold.score > best.score) best = fold;
    best.explains = explains;
  }
  return best;
}

/// What the segments that continue the surface leave free, degrees. Seldom asked: few points are exposed in their own
/// segment.
double SegmentContourRunner::border_deg(const Vector3& at, const ClosedBox& box) {
  const double own_deg = own_.exposure_deg(at);
  if (own_deg == 0.0 || continue_.empty()) return own_deg;
  if (!joined_known_) {
    const std::uint32_t label = own_.label();
    joined_.begin(label, box);
    joined_.add(*group_.part(label));
    for (const std::uint32_t other : continue_) joined_.add(*group_.part(other));
    joined_known_ = true;
  }
  return joined_.exposure_deg(at);
}

void SegmentContourRunner::add_edges(std::uint32_t slot) {
  for (const PlanarNeighbour& target : own_.edges(slot)) {
    edges_.push_back({own_.label(), task_.tree.id(slot), task_.tree.id(target.index), task_.tree.position(slot),
                      task_.tree.position(target.index)});
  }
}

ContourRecord SegmentContourRunner::fold_record(std::uint32_t slot, const SegmentFold& fold) const {
  const SegmentContourParameters& p = task_.parameters;
  ContourRecord record;
  record.id = task_.tree.id(slot);
  record.classes = kFold;
  if (p.view == ArrisParameters::View::kAbove) {
    record.classes |= fold_side(fold.line, {0.0, 0.0, 1.0});
  } else if (p.view == ArrisParameters::View::kPoint) {
    const LatticePoint position = task_.tree.position(slot);
    Vector3 view;
    for (int axis = 0; axis < 3; ++axis) {
      view[static_cast<std::size_t>(axis)] =
          p.viewpoint[static_cast<std::size_t>(axis)] - task_.lattice.world(axis, position[axis]);
    }
    record.classes |= fold_side(fold.line, view);
  }
  record.votes = 1;
  record.fold_strength = static_cast<float>((180.0 - fold.line.angle_deg) / p.fold_angle_deg);
  record.fold_angle_deg = static_cast<float>(fold.line.angle_deg);
  record.score = static_cast<float>(fold.score);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    record.to_edge[axis] = static_cast<float>(fold.to_line[axis] * task_.lattice.step);
  }
  return record;
}

/// The free directions as a share of those that a straight border shows.
ContourRecord SegmentContourRunner::border_record(std::uint32_t slot, double free_deg) const {
  const SegmentLengths& lengths = own_.lengths();
  const double half_rad = kPi / 2 - arc_cosine(std::min(lengths.spacing / lengths.two_alpha, 1.0));
  ContourRecord record;
  record.id = task_.tree.id(slot);
  record.classes = kBoundary;
  record.gap_deg = static_cast<float>(free_deg);
  record.score = static_cast<float>(std::min(1.0, free_deg / (2.0 * half_rad * kDegreesPerRadian)));
  return record;
}

}  // namespace arris
