#include "features/zheng/surface_projection.h"

#include <algorithm>
#include <cmath>

namespace arris {
namespace {

/// Points beside the expected box up to this share of its largest side are tried first.
constexpr double kNearShare = 0.4;
/// Fewer points than this are not worth a selection.
constexpr std::size_t kFewPoints = 64;

}  // namespace

void SurfaceProjection::begin(const SupervoxelFrame& frame) {
  frame_ = frame;
  all_.size = near_.size = 0;
}

void SurfaceProjection::add(const LabelledGroup& group, const LabelledPart& part) {
  std::size_t to = all_.size;
  all_.size += part.end - part.begin;
  for (auto* column : {&all_.a, &all_.b, &all_.w}) column->resize(std::max(column->size(), all_.size));
  for (std::size_t i = part.begin; i < part.end; ++i, ++to) {
    const Vector3 p = group.at(i);
    all_.a[to] = dot(frame_.u, p);
    all_.b[to] = dot(frame_.v, p);
    all_.w[to] = dot(frame_.n, p);
  }
}

void SurfaceProjection::expect(const ClosedBox& box) {
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
  for (auto* column : {&near_.a, &near_.b, &near_.w}) column->resize(std::max(column->size(), all_.size));
  std::size_t n = 0;
  for (std::size_t i = 0; i < all_.size; ++i) {
    near_.a[n] = all_.a[i];
    near_.b[n] = all_.b[i];
    near_.w[n] = all_.w[i];
    n += all_.a[i] * all_.a[i] + all_.b[i] * all_.b[i] + all_.w[i] * all_.w[i] < radius * radius;
  }
  near_.size = n;
}

void SurfaceProjection::find_neighbours(const Columns& points, const Vector3& at, double alpha) {
  for (auto* column : {&neighbours_.a, &neighbours_.b}) column->resize(std::max(column->size(), points.size));
  const double a = dot(frame_.u, at);
  const double b = dot(frame_.v, at);
  const double w = dot(frame_.n, at);
  const double unit = 1.0 / (2.0 * alpha);
  const double most_d2 = 4.0 * alpha * alpha;
  std::size_t n = 0;
  for (std::size_t i = 0; i < points.size; ++i) {
    // Without branches: every point is written, and the end advances past neighbours only.
    const double da = points.a[i] - a;
    const double db = points.b[i] - b;
    const double dw = points.w[i] - w;
    neighbours_.a[n] = da * unit;
    neighbours_.b[n] = db * unit;
    n += da * da + db * db + dw * dw < most_d2;
  }
  neighbours_.count = n;
}

double SurfaceProjection::exposure_deg(const Vector3& at, double alpha) {
  if (near_.size > 0) {
    find_neighbours(near_, at, alpha);
    if (exposed_.surely_blocked(neighbours_)) return 0.0;
  }
  find_neighbours(all_, at, alpha);
  return exposed_(neighbours_);
}

}  // namespace arris
