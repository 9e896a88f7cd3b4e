#include "synth/face.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "synth/deterministic_math.h"

namespace arris::synth {

namespace {

/// Even-odd rule, half-open along v.
bool in_polygon(const std::vector<Point2>& polygon, double u, double v) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 &a = polygon[i], &b = polygon[j];
    if ((a.v > v) != (b.v > v) && u < (b.u - a.u) * (v - a.v) / (b.v - a.v) + a.u) inside = !inside;
  }
  return inside;
}

double polygon_area(const std::vector<Point2>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    twice += polygon[j].u * polygon[i].v - polygon[i].u * polygon[j].v;
  }
  return 0.5 * std::abs(twice);
}

double segment_distance(const Point2& a, const Point2& b, double u, double v) {
  const double du = b.u - a.u, dv = b.v - a.v;
  const double squared = du * du + dv * dv;
  const double t = squared > 0.0 ? std::clamp(((u - a.u) * du + (v - a.v) * dv) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(u - a.u - t * du, v - a.v - t * dv);
}

double polygon_distance(const std::vector<Point2>& polygon, double u, double v) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    best = std::min(best, segment_distance(polygon[j], polygon[i], u, v));
  }
  return best;
}

std::vector<Point2> corners(const Rect2& r) {
  return {r.min, {r.max.u, r.min.v}, r.max, {r.min.u, r.max.v}};
}

/// Distance within the plane, from the centre's frame, to an arc of the face's sweep.
double arc_distance(const Face& face, double radius, double u, double v) {
  if (face.in_sweep(u, v)) return std::abs(std::hypot(u, v) - radius);
  return std::min(std::hypot(u - radius, v), std::hypot(u - radius * face.sweep_end.u, v - radius * face.sweep_end.v));
}

/// The same to the border of a disc, ring or sector.
double disc_border_distance(const Face& face, double u, double v) {
  double best = arc_distance(face, face.radius, u, v);
  if (face.inner_radius > 0.0) best = std::min(best, arc_distance(face, face.inner_radius, u, v));
  if (face.sweep_turns >= 1.0) return best;
  for (const Point2& side : {Point2{1.0, 0.0}, face.sweep_end}) {
    const double r = face.inner_radius, f = face.radius;
    best = std::min(best, segment_distance({r * side.u, r * side.v}, {f * side.u, f * side.v}, u, v));
  }
  return best;
}

/// Distance within the plane from a (u, v) that is not owned to the face.
double border_distance(const Face& face, double u, double v) {
  double best =
      face.disc
          ? disc_border_distance(face, u - face.radius, v - face.radius)
          : polygon_distance(face.outline.empty() ? corners({{0, 0}, {face.size_u, face.size_v}}) : face.outline, u, v);
  for (const Circle2& hole : face.circle_holes) {
    best = std::min(best, std::abs(std::hypot(u - hole.centre.u, v - hole.centre.v) - hole.radius));
  }
  for (const Rect2& hole : face.rect_holes) best = std::min(best, polygon_distance(corners(hole), u, v));
  return best;
}

}  // namespace

void Face::set_sweep(double turns) {
  const SinCos end = sin_cos_turns(turns);
  sweep_turns = turns;
  sweep_end = {end.cos, end.sin};
}

bool Face::in_sweep(double u, double v) const {
  if (sweep_turns >= 1.0) return true;
  const bool after_start = v >= 0.0, before_end = u * sweep_end.v - v * sweep_end.u >= 0.0;
  return sweep_turns <= 0.5 ? after_start && before_end : after_start || before_end;
}

bool Face::owns(double u, double v) const {
  if (u < 0.0 || v < 0.0 || u >= size_u || v >= size_v) return false;
  if (disc) {
    const double du = u - radius, dv = v - radius;
    const double squared = du * du + dv * dv;
    if (squared >= radius * radius || squared < inner_radius * inner_radius || !in_sweep(du, dv)) return false;
  } else if (!outline.empty() && !in_polygon(outline, u, v)) {
    return false;
  }
  for (const Circle2& hole : circle_holes) {
    const double du = u - hole.centre.u, dv = v - hole.centre.v;
    if (du * du + dv * dv < hole.radius * hole.radius) return false;
  }
  for (const Rect2& hole : rect_holes) {
    if (u >= hole.min.u && u < hole.max.u && v >= hole.min.v && v < hole.max.v) return false;
  }
  return true;
}

bool Face::fills(double u, double v, double w) const {
  if (!ellipsoid) return true;
  const double a = 2.0 * u / size_u - 1.0, b = 2.0 * v / size_v - 1.0, c = 2.0 * w / size_w - 1.0;
  return a * a + b * b + c * c < 1.0;
}

double Face::measure() const {
  constexpr double kPi = std::numbers::pi;
  switch (shape) {
    case Shape::kCylinder:
      return 2.0 * kPi * radius * size_v * sweep_turns;
    case Shape::kSphere:
      return 2.0 * kPi * radius * (radius - std::max(cap_height, -radius));
    case Shape::kVolume:
      return size_u * size_v * size_w * (ellipsoid ? kPi / 6.0 : 1.0);
    case Shape::kPlane:
      break;
  }
  double area = disc              ? kPi * (radius * radius - inner_radius * inner_radius) * sweep_turns
                : outline.empty() ? size_u * size_v
                                  : polygon_area(outline);
  for (const Circle2& hole : circle_holes) area -= kPi * hole.radius * hole.radius;
  for (const Rect2& hole : rect_holes) area -= (hole.max.u - hole.min.u) * (hole.max.v - hole.min.v);
  return area;
}

double Face::distance(const Vec3& point) const {
  const Vec3 local = point - origin;
  const double u = dot(local, eu), v = dot(local, ev), w = dot(local, ew);
  switch (shape) {
    case Shape::kSphere:
      if (w >= cap_height) return std::abs(norm(local) - radius);
      return std::hypot(std::hypot(u, v) - std::sqrt(radius * radius - cap_height * cap_height), w - cap_height);
    case Shape::kVolume:
      return std::sqrt(Box3{{0, 0, 0}, {size_u, size_v, size_w}}.squared_distance({u, v, w}));
    case Shape::kCylinder:
      return std::hypot(arc_distance(*this, radius, u, v), std::max({-w, 0.0, w - size_v}));
    case Shape::kPlane:
      break;
  }
  return owns(u, v) ? std::abs(w) : std::hypot(w, border_distance(*this, u, v));
}

Box3 Face::bounds() const {
  Box3 box;
  const auto reach = [&](double c) { return radius * std::sqrt(std::max(0.0, 1.0 - c * c)); };
  switch (shape) {
    case Shape::kSphere:
      box.include(origin);
      return box.expanded(radius);
    case Shape::kCylinder: {
      const Vec3 around{reach(ew.x), reach(ew.y), reach(ew.z)};
      const Vec3 top = origin + size_v * ew;
      for (const Vec3& end : {origin, top}) {
        box.include(end - around);
        box.include(end + around);
      }
      return box;
    }
    case Shape::kPlane:
    case Shape::kVolume:
      break;
  }
  for (const double w : {0.0, shape == Shape::kVolume ? size_w : 0.0}) {
    for (const double u : {0.0, size_u}) {
      for (const double v : {0.0, size_v}) box.include(at(u, v) + w * ew);
    }
  }
  return box;
}

}  // namespace arris::synth
