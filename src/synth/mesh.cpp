#include "synth/mesh.h"

#include <cmath>
#include <map>
#include <utility>

namespace arris::synth {

namespace {

constexpr double kFlat = 1e-9;  // Sine between polygons that are in one plane, or of a level edge.

/// Newell's normal: right for polygons that are not convex, too.
Vec3 normal_of(const Mesh& mesh, const std::vector<std::size_t>& polygon) {
  Vec3 sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    sum = sum + cross(mesh.corners[polygon[i]], mesh.corners[polygon[(i + 1) % polygon.size()]]);
  }
  return normalized(sum);
}

/// The polygon turned to be counter-clockwise seen from outside.
std::vector<std::size_t> outward(const Mesh& mesh, const std::vector<std::size_t>& polygon) {
  const Vec3 normal = normal_of(mesh, polygon);
  const bool upright = std::abs(normal.z) < kFlat;
  const bool turned = upright ? dot(normal, mesh.corners[polygon[0]] - mesh.inside) < 0.0 : normal.z < 0.0;
  return turned ? std::vector<std::size_t>(polygon.rbegin(), polygon.rend()) : polygon;
}

/// The polygon's corners from one on whose angle is convex, as SceneModel::polygon() wants it.
std::vector<Vec3> from_convex_corner(const Mesh& mesh, const std::vector<std::size_t>& polygon, const Vec3& normal) {
  const std::size_t n = polygon.size();
  for (std::size_t first = 0; first < n; ++first) {
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < n; ++i) corners.push_back(mesh.corners[polygon[(first + i) % n]]);
    if (dot(cross(corners[1] - corners[0], corners[2] - corners[1]), normal) > kFlat) return corners;
  }
  return {};
}

}  // namespace

void add_mesh(SceneModel& model, const Mesh& mesh, const Material& material, const MeshRoles& roles) {
  struct Side {
    std::vector<Vec3> into;  // From the side into each of its polygons.
    std::vector<Vec3> normals;
  };
  std::map<std::pair<std::size_t, std::size_t>, Side> sides;
  for (const auto& given : mesh.polygons) {
    const std::vector<std::size_t> polygon = outward(mesh, given);
    const Vec3 normal = normal_of(mesh, polygon);
    model.polygon(from_convex_corner(mesh, polygon, normal), material);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      Side& side = sides[std::minmax(a, b)];
      side.into.push_back(normalized(cross(normal, mesh.corners[b] - mesh.corners[a])));
      side.normals.push_back(normal);
    }
  }
  for (const auto& [ends, side] : sides) {
    const Vec3 a = mesh.corners[ends.first], b = mesh.corners[ends.second];
    if (side.into.size() == 1) {
      model.segment(EdgeKind::kBoundary, roles.free, a, b);
      continue;
    }
    if (norm(cross(side.normals[0], side.normals[1])) < kFlat) continue;
    const bool convex = dot(side.normals[0], side.into[1]) < 0.0;
    const bool level = std::abs(normalized(b - a).z) < kFlat;
    const std::string& role = !convex ? roles.inside : level ? roles.level : roles.sloping;
    model.segment(convex ? EdgeKind::kConvex : EdgeKind::kConcave, role, a, b,
                  dihedral_deg(a, b, side.into[0], side.into[1]));
  }
}

}  // namespace arris::synth
