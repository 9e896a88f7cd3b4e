#include "evaluate/truth_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arris::evaluate {

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

double segment_distance(const TruthEdge& edge, const Vec3& point) {
  const Vec3 along = edge.b - edge.a;
  const Vec3 to_point = point - edge.a;
  const double squared = dot(along, along);
  const double t = squared > 0.0 ? std::clamp(dot(to_point, along) / squared, 0.0, 1.0) : 0.0;
  return norm(to_point - t * along);
}

double arc_distance(const TruthEdge& edge, const Vec3& point) {
  const Vec3 to_point = point - edge.a;
  const double radius = norm(edge.start);
  const double height = dot(to_point, edge.b);
  const Vec3 in_plane = to_point - height * edge.b;
  if (!edge.closed()) {
    const Vec3 side = cross(edge.b, edge.start);
    double azimuth_deg = std::atan2(dot(in_plane, side), dot(in_plane, edge.start)) / kRadPerDeg;
    if (azimuth_deg < 0.0) azimuth_deg += 360.0;
    if (azimuth_deg > edge.sweep_deg)
      return std::min(norm(point - edge.point_at(0.0)), norm(point - edge.point_at(1.0)));
  }
  return std::hypot(norm(in_plane) - radius, height);
}

}  // namespace

double TruthEdge::length() const {
  return shape == Shape::kSegment ? norm(b - a) : norm(start) * sweep_deg * kRadPerDeg;
}

Vec3 TruthEdge::point_at(double fraction) const {
  if (shape == Shape::kSegment) return a + fraction * (b - a);
  const double azimuth = fraction * sweep_deg * kRadPerDeg;
  return a + std::cos(azimuth) * start + std::sin(azimuth) * cross(b, start);
}

double TruthEdge::distance(const Vec3& point) const {
  return shape == Shape::kSegment ? segment_distance(*this, point) : arc_distance(*this, point);
}

TruthEdge make_segment(EdgeKind kind, std::string role, const Vec3& from, const Vec3& to, double angle_deg) {
  TruthEdge edge;
  edge.kind = kind;
  edge.role = std::move(role);
  edge.angle_deg = angle_deg;
  edge.a = from;
  edge.b = to;
  return edge;
}

TruthEdge make_circle(EdgeKind kind, std::string role, const Vec3& centre, const Vec3& axis, double radius,
                      double angle_deg) {
  TruthEdge edge;
  edge.kind = kind;
  edge.shape = TruthEdge::Shape::kArc;
  edge.role = std::move(role);
  edge.angle_deg = angle_deg;
  edge.a = centre;
  edge.b = normalized(axis);
  // Any direction across the axis will do; the coordinate axis least aligned with it is never parallel.
  const Vec3 size{std::abs(edge.b.x), std::abs(edge.b.y), std::abs(edge.b.z)};
  const Vec3 helper = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                      : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1};
  edge.start = radius * normalized(helper - dot(helper, edge.b) * edge.b);
  edge.sweep_deg = 360.0;
  return edge;
}

}  // namespace arris::evaluate
