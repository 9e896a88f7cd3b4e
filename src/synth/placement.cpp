#include "synth/placement.h"

#include <cmath>

#include "synth/counter_random.h"

namespace arris::synth {

Placement::Placement(bool rotate, const Vec3& shift, std::uint64_t seed) : rotate_(rotate), shift_(shift) {
  // A normalised vector of four normal numbers is a uniformly distributed unit quaternion.
  PointRandom random(derive_key(seed, 0x726f74617465ULL));
  double w = random.normal(), x = random.normal(), y = random.normal(), z = random.normal();
  const double scale = 1.0 / std::sqrt(w * w + x * x + y * y + z * z);
  w *= scale;
  x *= scale;
  y *= scale;
  z *= scale;
  rows_[0] = {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)};
  rows_[1] = {2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)};
  rows_[2] = {2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)};
}

void Placement::apply(io::FreshPoint& point) const {
  const Vec3 moved = apply(Vec3{point.x, point.y, point.z});
  point.x = moved.x;
  point.y = moved.y;
  point.z = moved.z;
}

evaluate::TruthEdge Placement::apply(const evaluate::TruthEdge& edge) const {
  evaluate::TruthEdge moved = edge;
  moved.a = apply(edge.a);
  if (edge.shape == evaluate::TruthEdge::Shape::kSegment) {
    moved.b = apply(edge.b);
  } else {
    moved.b = turn(edge.b);
    moved.start = turn(edge.start);
  }
  return moved;
}

Box3 Placement::apply(const Box3& box) const {
  Box3 moved;
  for (const double x : {box.min.x, box.max.x}) {
    for (const double y : {box.min.y, box.max.y}) {
      for (const double z : {box.min.z, box.max.z}) moved.include(apply(Vec3{x, y, z}));
    }
  }
  return moved;
}

Vec3 Placement::undo(const Vec3& p) const {
  const Vec3 q = p - shift_;
  return rotate_ ? q.x * rows_[0] + q.y * rows_[1] + q.z * rows_[2] : q;
}

}  // namespace arris::synth
