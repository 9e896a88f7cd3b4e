#include "features/segment_contours/shape_projection.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace arris {
namespace {

/// Points beside the box up to this share of its largest side are tried first: what some neighbours block stays
/// blocked.
constexpr double kNearShare = 0.4;

}  // namespace

void ShapeProjection::Columns::make_room(std::size_t count) {
  if (a.size() >= count) return;
  for (auto* column : {&a, &b}) column->resize(count);
  slot.resize(count);
}

void ShapeProjection::begin(std::uint32_t label, const ClosedBox& box) {
  label_ = label;
  frame_ = plane_frame(task_.plane(label).normal);
  lengths_ = task_.lengths(label);
  near_.size = all_.size = 0;
  pending_.clear();
  double diagonal2 = 0.0;
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double side = static_cast<double>(std::int64_t{box.max[axis]} - box.min[axis]);
    diagonal2 += side * side;
    longest = std::max(longest, side);
  }
  near_radius_ = 0.5 * std::sqrt(diagonal2) + kNearShare * longest;
}

void ShapeProjection::project(std::size_t index, Columns& points) const {
  if (std::fabs(task_.distance(label_, group_.slot(index))) > lengths_.slab) return;
  const Vector3 p = group_.at(index);
  points.a[points.size] = dot(frame_.u, p);
  points.b[points.size] = dot(frame_.v, p);
  points.slot[points.size++] = group_.slot(index);
}

void ShapeProjection::add(const LabelledPart& part) {
  pending_.push_back(part);
  near_.make_room(near_.size + (part.end - part.begin));
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const Vector3 p = group_.at(i);
    if (dot(p, p) < near_radius_ * near_radius_) project(i, near_);
  }
}

void ShapeProjection::complete() {
  for (const LabelledPart& part : pending_) {
    all_.make_room(all_.size + (part.end - part.begin));
    for (std::size_t i = part.begin; i < part.end; ++i) project(i, all_);
  }
  pending_.clear();
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
  find_neighbours(near_, at);
  if (exposed_.surely_blocked(neighbours_)) return true;
  complete();
  find_neighbours(all_, at);
  return exposed_.surely_blocked(neighbours_);
}

double ShapeProjection::exposure_deg(const Vector3& at) {
  complete();
  find_neighbours(all_, at);
  return exposed_(neighbours_);
}

const std::vector<PlanarNeighbour>& ShapeProjection::edges(std::uint32_t slot) {
  complete();
  const Vector3 at = group_.relative(task_.tree, slot);
  const double a = dot(frame_.u, at);
  const double b = dot(frame_.v, at);
  around_.clear();
  for (std::size_t i = 0; i < all_.size; ++i) {
    const double da = all_.a[i] - a;
    const double db = all_.b[i] - b;
    if (std::max(std::fabs(da), std::fabs(db)) > lengths_.two_alpha) continue;
    if (da == 0.0 && db == 0.0) {
      if (task_.tree.id(all_.slot[i]) < task_.tree.id(slot)) return none_;
      continue;
    }
    around_.push_back({frame_units(da), frame_units(db), all_.slot[i]});
  }
  std::sort(around_.begin(), around_.end(), [&](const PlanarNeighbour& p, const PlanarNeighbour& q) {
    return std::make_tuple(p.x, p.y, task_.tree.id(p.index)) < std::make_tuple(q.x, q.y, task_.tree.id(q.index));
  });
  const auto same = [](const PlanarNeighbour& p, const PlanarNeighbour& q) { return p.x == q.x && p.y == q.y; };
  around_.erase(std::unique(around_.begin(), around_.end(), same), around_.end());
  return edges_.leaving(around_, frame_units(lengths_.two_alpha));
}

}  // namespace arris
