#include "features/zheng/zheng_runner.h"

#include <algorithm>
#include <cmath>

#include "core/columns.h"
#include "features/neighbourhood/group_box.h"
#include "features/zheng/mutual_nearest.h"
#include "features/zheng/supervoxel_pair.h"
#include "features/zheng/zheng_score.h"

namespace arris {

template <class Test>
void ZhengRunner::for_each_run(Test&& test) {
  for (std::size_t begin = 0; begin < queries_.size();) {
    std::size_t end = begin + 1;
    while (end < queries_.size() && queries_[end].label == queries_[begin].label) ++end;
    test(Run(queries_).subspan(begin, end - begin), *group_.part(queries_[begin].label));
    begin = end;
  }
}

void ZhengRunner::run(std::span<const std::uint32_t> slots) {
  queries_.clear();
  for (const std::uint32_t slot : slots) {
    if (task_.labels[slot] != 0) queries_.push_back({task_.labels[slot], slot, {}});
  }
  if (queries_.empty()) return;
  const ClosedBox box =
      detail::box_of(task_.tree, std::span<const Query>(queries_), [](const Query& query) { return query.slot; });
  std::sort(queries_.begin(), queries_.end(),
            [](const Query& a, const Query& b) { return a.label != b.label ? a.label < b.label : a.slot < b.slot; });
  const ZhengParameters& parameters = task_.settings.parameters;
  const ZhengLengths& lengths = task_.settings.typical;
  const double reach = std::max({2.0 * lengths.alpha, lengths.seam, lengths.cap});
  group_.gather(task_.tree, task_.labels, box, reach);
  if (parameters.boundary) {
    for_each_run([&](Run run, const LabelledPart& own) { test_borders(run, own, box); });
  }
  if (parameters.fold && any_may_touch()) {
    // A partner is within the cap, and what might be nearer to the partner within the cap of that.
    if (reach < 2.0 * lengths.cap) group_.gather(task_.tree, task_.labels, box, 2.0 * lengths.cap);
    for_each_run([this](Run run, const LabelledPart& own) {
      for (const LabelledPart& other : group_.parts()) {
        double angle_deg = 0.0;
        if (may_touch(own, other, angle_deg)) test_contacts(run, own, other, angle_deg);
      }
    });
  }
  for (Query& query : queries_) {
    if (query.record.classes == 0) continue;
    query.record.id = task_.tree.id(query.slot);
    found_.push_back({query.slot, query.record});
  }
}

void ZhengRunner::test_borders(Run run, const LabelledPart& own, const ClosedBox& box) {
  const ZhengLengths& lengths = task_.settings.typical;
  const SupervoxelFrame frame = supervoxel_frame(task_.table, own.label);
  if (frame.defined) {
    surface_.begin(frame);
    surface_.add(group_, own);
    surface_.expect(box);
  }
  for (Query& query : run) {
    const Vector3 at = group_.relative(task_.tree, query.slot);
    if (near_neighbour(own, at, lengths.seam)) continue;
    const double free_deg = frame.defined ? surface_.exposure_deg(at, lengths.alpha) : 360.0;
    if (free_deg == 0.0) continue;
    query.record.classes |= kBoundary;
    query.record.gap_deg = static_cast<float>(free_deg);
    query.record.score = std::max(query.record.score, border_score(free_deg, lengths));
  }
}

/// True if a point of an adjacent supervoxel is no farther than `distance`.
bool ZhengRunner::near_neighbour(const LabelledPart& own, const Vector3& at, double distance) const {
  for (const LabelledPart& other : group_.parts()) {
    if (other.label == own.label || !task_.table.adjacent(own.label, other.label)) continue;
    if (any_within(group_, other, at, distance * distance)) return true;
  }
  return false;
}

bool ZhengRunner::may_touch(const LabelledPart& own, const LabelledPart& other, double& angle_deg) const {
  if (other.label == own.label || !task_.table.adjacent(own.label, other.label)) return false;
  angle_deg = normal_angle_deg(task_.table, own.label, other.label);
  return angle_deg > task_.settings.parameters.angle_deg;
}

bool ZhengRunner::any_may_touch() {
  bool any = false;
  if (group_.parts().size() < 2) return false;
  for_each_run([&](Run, const LabelledPart& own) {
    double angle_deg = 0.0;
    for (const LabelledPart& other : group_.parts()) any = any || may_touch(own, other, angle_deg);
  });
  return any;
}

void ZhengRunner::test_contacts(Run run, const LabelledPart& own, const LabelledPart& other, double angle_deg) {
  const double cap = task_.settings.typical.cap;
  const Vector3 origin = group_.origin();
  for (Query& query : run) {
    const NearestPoint partner = mutual_nearest(task_.tree, group_, query.slot, own, other, cap * cap);
    if (!std::isfinite(partner.d2)) continue;
    const Vector3 here = group_.relative(task_.tree, query.slot);
    const Vector3 there = group_.at(partner.index);
    Vector3 contact;
    for (std::size_t axis = 0; axis < 3; ++axis) contact[axis] = origin[axis] + 0.5 * (here[axis] + there[axis]);
    ContourRecord record;
    record.classes = kSupervoxelContact | kFold;
    record.votes = 1;
    record.fold_strength = static_cast<float>(angle_deg / task_.settings.parameters.angle_deg);
    record.fold_angle_deg = static_cast<float>(interior_angle_deg(task_.table, own.label, other.label, contact));
    record.score = contact_score(std::sqrt(partner.d2), angle_deg, task_.settings);
    combine(query.record, record);
  }
}

}  // namespace arris
