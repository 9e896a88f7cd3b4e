#include "features/segment_contours/shape_projection.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace arris {
namespace {

/// Points beside the expected box up to this share of its largest side are tried first.
constexpr double kNearShare = 0.4;
/// Fewer points than this are not worth a selection.
constexpr std::size_t kFewPoints = 64;

}  // namespace

void ShapeProjection::Columns::make_room(std::size_t count) {
  if (a.size() >= count) return;
  for (auto* column : {&a, &b}) column->resize(count);
  slot.resize(count);
}

void ShapeProjection::begin(const SegmentTask& task, std::uint32_t label) {
  label_ = label;
  frame_ = plane_frame(task.plane(label).normal);
  lengths_ = task.lengths(label);
  all_.size = near_.size = 0;
}

void ShapeProjection::add(const SegmentTask& task, const LabelledGroup& group, const LabelledPart& part) {
  all_.make_room(all_.size + (part.end - part.begin));
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (std::fabs(task.distance(label_, group.slot(i))) > lengths_.slab) continue;
    const Vector3 p = group.at(i);
    all_.a[all_.size] = dot(frame_.u, p);
    all_.b[all_.size] = dot(frame_.v, p);
    all_.slot[all_.size++] = group.slot(i);
  }
}

void ShapeProjection::expect(const ClosedBox& box) {
  near_.size = 0;
  if (all_.size < kFewPoints) return;
  double diagonal2 = 0.0;
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double side = static_cast<double>(std::int64_t{box.max[axis]} - box.min[axis]);
    diagonal2 += side * side;
    longest = std::max(longest, side);
  }
  const double radius = 0.5 * std::sqrt(diagonal2) + kNearShare * longest;
  near_.make_room(all_.size);
  std::size_t n = 0;
  for (std::size_t i = 0; i < all_.size; ++i) {
    near_.a[n] = all_.a[i];
    near_.b[n] = all_.b[i];
    n += all_.a[i] * all_.a[i] + all_.b[i] * all_.b[i] < radius * radius;
  }
  near_.size = n;
}

void ShapeProjection::find_neighbours(const Columns& points, const Vector3& at) {
  for (auto* column : {&neighbours_.a, &neighbours_.b}) column->resize(std::max(column->size(), points.size));
  const double a = dot(frame_.u, at);
  const double b = dot(frame_.v, at);
  const double unit = 1.0 / lengths_.two_alpha;
  const double most_d2 = lengths_.two_alpha * lengths_.two_alpha;
  std::size_t n = 0;
  for (std::size_t i = 0; i < points.size; ++i) {
    // Without branches: every point is written, and the end advances past neighbours only.
    const double da = points.a[i] - a;
    const double db = points.b[i] - b;
    neighbours_.a[n] = da * unit;
    neighbours_.b[n] = db * unit;
    n += da * da + db * db < most_d2;
  }
  neighbours_.count = n;
}

bool ShapeProjection::surely_inside(const Vector3& at) {
  if (near_.size > 0) {
    find_neighbours(near_, at);
    if (exposed_.surely_blocked(neighbours_)) return true;
  }
  find_neighbours(all_, at);
  return exposed_.surely_blocked(neighbours_);
}

double ShapeProjection::exposure_deg(const Vector3& at) {
  find_neighbours(all_, at);
  return exposed_(neighbours_);
}

const std::vector<PlanarNeighbour>& ShapeProjection::edges(const SegmentTask& task, const LabelledGroup& group,
                                                           std::uint32_t slot) {
  const Vector3 at = group.relative(task.tree, slot);
  const double a = dot(frame_.u, at);
  const double b = dot(frame_.v, at);
  around_.clear();
  for (std::size_t i = 0; i < all_.size; ++i) {
    const double da = all_.a[i] - a;
    const double db = all_.b[i] - b;
    if (std::max(std::fabs(da), std::fabs(db)) > lengths_.two_alpha) continue;
    if (da == 0.0 && db == 0.0) {
      if (task.tree.id(all_.slot[i]) < task.tree.id(slot)) return none_;
      continue;
    }
    around_.push_back({frame_units(da), frame_units(db), all_.slot[i]});
  }
  std::sort(around_.begin(), around_.end(), [&](const PlanarNeighbour& p, const PlanarNeighbour& q) {
    return std::make_tuple(p.x, p.y, task.tree.id(p.index)) < std::make_tuple(q.x, q.y, task.tree.id(q.index));
  });
  const auto same = [](const PlanarNeighbour& p, const PlanarNeighbour& q) { return p.x == q.x && p.y == q.y; };
  around_.erase(std::unique(around_.begin(), around_.end(), same), around_.end());
  return edges_.leaving(around_, frame_units(lengths_.two_alpha));
}

}  // namespace arris
