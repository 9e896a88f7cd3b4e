#include "synth/occluders.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace arris::synth {

namespace {

constexpr double kContact = 1e-7;      // Metres before the target that count as touching it: far above rounding.
constexpr double kBoxMargin = 1e-9;    // Metres; above the rounding of bounds.
constexpr double kLeastSlope = 1e-30;  // Stands for 0 so that its inverse is finite.
constexpr std::uint32_t kLeafFaces = 2;

bool plane_crosses(const Face& face, const Vec3& from, const Vec3& ray, double last) {
  const Vec3 local = from - face.origin;
  const double t = -dot(local, face.ew) / dot(ray, face.ew);  // Infinite or NaN in the plane: fails the comparison.
  if (!(t > 0.0 && t < last)) return false;
  const Vec3 place = local + t * ray;
  return face.owns(dot(place, face.eu), dot(place, face.ev));
}

bool cylinder_crosses(const Face& face, const Vec3& from, const Vec3& ray, double last) {
  const Vec3 local = from - face.origin;
  const double ou = dot(local, face.eu), ov = dot(local, face.ev), ow = dot(local, face.ew);
  const double du = dot(ray, face.eu), dv = dot(ray, face.ev), dw = dot(ray, face.ew);
  const double a = du * du + dv * dv;
  const double b = ou * du + ov * dv;
  const double discriminant = b * b - a * (ou * ou + ov * ov - face.radius * face.radius);
  if (!(discriminant > 0.0) || !(a > 0.0)) return false;
  const double root = std::sqrt(discriminant);
  for (const double t : {(-b - root) / a, (-b + root) / a}) {
    const double along = ow + t * dw;
    if (t > 0.0 && t < last && along >= 0.0 && along < face.size_v) return true;
  }
  return false;
}

bool crosses(const Face& face, const Vec3& from, const Vec3& ray, double last) {
  if (face.shape == Face::Shape::kPlane) return plane_crosses(face, from, ray, last);
  return face.shape == Face::Shape::kCylinder && cylinder_crosses(face, from, ray, last);
}

Vec3 inverse(const Vec3& ray) {
  const auto one = [](double d) { return 1.0 / (std::abs(d) < kLeastSlope ? kLeastSlope : d); };
  return {one(ray.x), one(ray.y), one(ray.z)};
}

bool crosses(const Box3& box, const Vec3& from, const Vec3& inverse_ray) {
  double first = 0.0, last = 1.0;
  const auto cut = [&](double low, double high, double start, double slope) {
    const double a = (low - start) * slope, b = (high - start) * slope;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  };
  cut(box.min.x, box.max.x, from.x, inverse_ray.x);
  cut(box.min.y, box.max.y, from.y, inverse_ray.y);
  cut(box.min.z, box.max.z, from.z, inverse_ray.z);
  return first <= last;
}

}  // namespace

Occluders::Occluders(const SceneModel& model) : faces_(model.faces) {
  std::vector<Box3> boxes;
  for (std::uint32_t i = 0; i < faces_.size(); ++i) {
    boxes.push_back(faces_[i].bounds().expanded(kBoxMargin));
    order_.push_back(i);
  }
  if (!boxes.empty()) build(0, static_cast<std::uint32_t>(boxes.size()), boxes);
}

void Occluders::build(std::uint32_t begin, std::uint32_t end, const std::vector<Box3>& boxes) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Box3 all;
  for (std::uint32_t i = begin; i < end; ++i) all.include(boxes[order_[i]]);
  nodes_[index] = {all, begin, end, 0};
  if (end - begin <= kLeafFaces) return;
  const Vec3 size = all.max - all.min;
  double Vec3::*const axis = size.x >= size.y && size.x >= size.z ? &Vec3::x : size.y >= size.z ? &Vec3::y : &Vec3::z;
  std::sort(order_.begin() + begin, order_.begin() + end, [&](std::uint32_t i, std::uint32_t j) {
    const double a = boxes[i].min.*axis + boxes[i].max.*axis, b = boxes[j].min.*axis + boxes[j].max.*axis;
    return a < b || (a == b && i < j);
  });
  const std::uint32_t middle = begin + (end - begin) / 2;
  build(begin, middle, boxes);
  nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end, boxes);
}

bool Occluders::blocked(const Vec3& from, const Vec3& to, std::uint32_t own, std::uint32_t& hint) const {
  const Vec3 ray = to - from;
  const double length = norm(ray);
  if (!(length > kContact) || nodes_.empty()) return false;
  const double last = 1.0 - kContact / length;
  const auto in_the_way = [&](std::uint32_t face) {
    return (face != own || faces_[face].shape != Face::Shape::kPlane) && crosses(faces_[face], from, ray, last);
  };
  if (hint < faces_.size() && in_the_way(hint)) return true;
  const Vec3 slope = inverse(ray);
  std::array<std::uint32_t, 64> stack;  // Halving 2^32 faces takes 32 levels.
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const std::uint32_t index = stack[--waiting];
    const Node& node = nodes_[index];
    if (!crosses(node.box, from, slope)) continue;
    if (node.right != 0) {
      stack[waiting++] = node.right;
      stack[waiting++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (!in_the_way(order_[i])) continue;
      hint = order_[i];
      return true;
    }
  }
  return false;
}

}  // namespace arris::synth
