#include "synth/scene_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arris::synth {

namespace {

/// Completes a frame whose ew is given; exact for axes along coordinates.
void frame_from_normal(Face& face, const Vec3& normal) {
  face.ew = normalized(normal);
  const Vec3 size{std::abs(face.ew.x), std::abs(face.ew.y), std::abs(face.ew.z)};
  const Vec3 helper = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                      : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1};
  face.eu = normalized(helper - dot(helper, face.ew) * face.ew);
  face.ev = cross(face.ew, face.eu);
}

}  // namespace

Face& SceneModel::rectangle(const Vec3& a, const Vec3& b, const Vec3& d, const Material& material) {
  Face& face = faces.emplace_back();
  face.origin = a;
  face.size_u = norm(b - a);
  face.size_v = norm(d - a);
  face.eu = normalized(b - a);
  face.ev = normalized(d - a);
  face.ew = cross(face.eu, face.ev);
  face.material = material;
  return face;
}

Face& SceneModel::polygon(const std::vector<Vec3>& vertices, const Material& material) {
  Face& face = faces.emplace_back();
  face.eu = normalized(vertices[1] - vertices[0]);
  face.ew = normalized(cross(vertices[1] - vertices[0], vertices[2] - vertices[1]));
  face.ev = cross(face.ew, face.eu);
  face.material = material;
  Point2 least, most;
  for (const Vec3& vertex : vertices) {
    const Point2 p{dot(vertex - vertices[0], face.eu), dot(vertex - vertices[0], face.ev)};
    least = {std::min(least.u, p.u), std::min(least.v, p.v)};
    most = {std::max(most.u, p.u), std::max(most.v, p.v)};
    face.outline.push_back(p);
  }
  for (Point2& p : face.outline) p = {p.u - least.u, p.v - least.v};
  face.origin = vertices[0] + least.u * face.eu + least.v * face.ev;
  face.size_u = most.u - least.u;
  face.size_v = most.v - least.v;
  return face;
}

Face& SceneModel::disc(const Vec3& centre, const Vec3& normal, double radius, const Material& material) {
  Face& face = faces.emplace_back();
  frame_from_normal(face, normal);
  face.disc = true;
  face.radius = radius;
  face.size_u = face.size_v = 2.0 * radius;
  face.origin = centre - radius * face.eu - radius * face.ev;
  face.material = material;
  return face;
}

Face& SceneModel::cylinder(const Vec3& base, const Vec3& axis, double height, double radius, const Material& material) {
  Face& face = faces.emplace_back();
  frame_from_normal(face, axis);
  face.shape = Face::Shape::kCylinder;
  face.origin = base;
  face.radius = radius;
  face.size_u = 2.0 * std::numbers::pi * radius;
  face.size_v = height;
  face.material = material;
  return face;
}

Face& SceneModel::cylinder_part(const Vec3& base, const Vec3& axis, const Vec3& start, double turns,
                                const Material& material) {
  Face& face = cylinder(base, axis, norm(axis), norm(start), material);
  face.eu = normalized(start);
  face.ev = cross(face.ew, face.eu);
  face.size_u *= turns;
  face.set_sweep(turns);
  return face;
}

Face& SceneModel::ring_part(const Vec3& centre, const Vec3& normal, const Vec3& start, double inner_radius,
                            double turns) {
  Face& face = disc(centre, normal, norm(start), {});
  face.eu = normalized(start);
  face.ev = cross(face.ew, face.eu);
  face.origin = centre - face.radius * face.eu - face.radius * face.ev;
  face.inner_radius = inner_radius;
  face.set_sweep(turns);
  return face;
}

void SceneModel::segment(EdgeKind kind, const std::string& role, const Vec3& from, const Vec3& to, double angle_deg) {
  edges.push_back(evaluate::make_segment(kind, role, from, to, angle_deg));
}

void SceneModel::loop(EdgeKind kind, const std::string& role, const std::vector<Vec3>& vertices, double angle_deg) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    segment(kind, role, vertices[i], vertices[(i + 1) % vertices.size()], angle_deg);
  }
}

void SceneModel::circle(EdgeKind kind, const std::string& role, const Vec3& centre, const Vec3& axis, double radius,
                        double angle_deg) {
  edges.push_back(evaluate::make_circle(kind, role, centre, axis, radius, angle_deg));
}

void SceneModel::arc(EdgeKind kind, const std::string& role, const Vec3& centre, const Vec3& axis, const Vec3& start,
                     double sweep_deg, double angle_deg) {
  TruthEdge edge = evaluate::make_circle(kind, role, centre, axis, norm(start), angle_deg);
  edge.start = start;
  edge.sweep_deg = sweep_deg;
  edges.push_back(edge);
}

Box3 SceneModel::bounds() const {
  Box3 box;
  for (const Face& face : faces) box.include(face.bounds());
  return box;
}

double dihedral_deg(const Vec3& a, const Vec3& b, const Vec3& into_1, const Vec3& into_2) {
  const Vec3 along = normalized(b - a);
  const Vec3 across_1 = normalized(into_1 - dot(into_1, along) * along);
  const Vec3 across_2 = normalized(into_2 - dot(into_2, along) * along);
  return std::acos(std::clamp(dot(across_1, across_2), -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

}  // namespace arris::synth
