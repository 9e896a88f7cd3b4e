#include "synth/surface_numbers.h"

#include <array>
#include <cmath>
#include <numeric>

#include "synth/deterministic_math.h"

namespace arris::synth {

namespace {

constexpr double kSameLength = 1e-6;     // Metres: far above rounding, far below any spacing.
constexpr double kSameDirection = 1e-9;  // Sine of an angle.
constexpr int kBorderSamples = 256;      // Of each side; a seam must hold two neighbouring ones.

bool parallel(const Vec3& a, const Vec3& b) {
  return norm(cross(a, b)) < kSameDirection;
}

bool same_surface(const Face& a, const Face& b) {
  if (a.shape != b.shape || a.material_number != b.material_number) return false;
  const Vec3 apart = b.origin - a.origin;
  switch (a.shape) {
    case Face::Shape::kPlane:
      return parallel(a.ew, b.ew) && std::abs(dot(apart, a.ew)) < kSameLength;
    case Face::Shape::kCylinder:
      return parallel(a.ew, b.ew) && std::abs(a.radius - b.radius) < kSameLength &&
             norm(apart - dot(apart, a.ew) * a.ew) < kSameLength;
    case Face::Shape::kSphere:
      return norm(apart) < kSameLength && std::abs(a.radius - b.radius) < kSameLength;
    case Face::Shape::kVolume:
      break;
  }
  return false;
}

/// Walks along the sides of a face and looks whether `other` is there.
class BorderWalk {
 public:
  BorderWalk(const Face& face, const Face& other) : face_(face), other_(other) {}

  bool meets() const {
    switch (face_.shape) {
      case Face::Shape::kPlane:
        return (face_.disc ? disc_meets() : outline_meets()) || holes_meet();
      case Face::Shape::kCylinder:
        return cylinder_meets();
      case Face::Shape::kSphere: {
        if (face_.cap_height <= -face_.radius) return false;
        const double rim = std::sqrt(face_.radius * face_.radius - face_.cap_height * face_.cap_height);
        return arc_meets(face_.origin + face_.cap_height * face_.ew, rim, 1.0);
      }
      case Face::Shape::kVolume:
        break;
    }
    return false;
  }

 private:
  template <class Curve>
  bool curve_meets(const Curve& curve) const {
    bool before = false;
    for (int i = 0; i < kBorderSamples; ++i) {
      const bool here = other_.distance(curve((i + 0.5) / kBorderSamples)) < kSameLength;
      if (here && before) return true;
      before = here;
    }
    return false;
  }
  bool side_meets(const Vec3& from, const Vec3& to) const {
    return curve_meets([&](double t) { return from + t * (to - from); });
  }
  bool arc_meets(const Vec3& centre, double radius, double turns) const {
    return curve_meets([&](double t) {
      const SinCos angle = sin_cos_turns(t * turns);
      return centre + radius * angle.cos * face_.eu + radius * angle.sin * face_.ev;
    });
  }
  bool polygon_meets(const std::vector<Point2>& corners) const {
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      if (side_meets(face_.at(corners[j].u, corners[j].v), face_.at(corners[i].u, corners[i].v))) return true;
    }
    return false;
  }
  bool rectangle_meets(const Point2& min, const Point2& max) const {
    return polygon_meets({min, {max.u, min.v}, max, {min.u, max.v}});
  }

  bool outline_meets() const {
    return face_.outline.empty() ? rectangle_meets({0.0, 0.0}, {face_.size_u, face_.size_v})
                                 : polygon_meets(face_.outline);
  }
  bool holes_meet() const {
    for (const Circle2& hole : face_.circle_holes) {
      if (arc_meets(face_.at(hole.centre.u, hole.centre.v), hole.radius, 1.0)) return true;
    }
    for (const Rect2& hole : face_.rect_holes) {
      if (rectangle_meets(hole.min, hole.max)) return true;
    }
    return false;
  }
  /// The directions at which a sweep of less than a turn begins and ends.
  std::array<Vec3, 2> sweep_sides() const {
    return {face_.eu, face_.sweep_end.u * face_.eu + face_.sweep_end.v * face_.ev};
  }
  bool disc_meets() const {
    const Vec3 centre = face_.at(face_.radius, face_.radius);
    if (arc_meets(centre, face_.radius, face_.sweep_turns)) return true;
    if (face_.inner_radius > 0.0 && arc_meets(centre, face_.inner_radius, face_.sweep_turns)) return true;
    if (face_.sweep_turns >= 1.0) return false;
    for (const Vec3& side : sweep_sides()) {
      if (side_meets(centre + face_.inner_radius * side, centre + face_.radius * side)) return true;
    }
    return false;
  }
  bool cylinder_meets() const {
    const Vec3 along = face_.size_v * face_.ew;
    for (const Vec3& end : {face_.origin, face_.origin + along}) {
      if (arc_meets(end, face_.radius, face_.sweep_turns)) return true;
    }
    if (face_.sweep_turns >= 1.0) return false;
    for (const Vec3& side : sweep_sides()) {
      const Vec3 foot = face_.origin + face_.radius * side;
      if (side_meets(foot, foot + along)) return true;
    }
    return false;
  }

  const Face& face_;
  const Face& other_;
};

bool overlap(const Box3& a, const Box3& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
         b.min.z <= a.max.z;
}

}  // namespace

void number_surfaces(std::vector<Face>& faces) {
  std::vector<std::size_t> parent(faces.size());  // The least face known to be of the same surface leads to it.
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto first_of = [&](std::size_t face) {
    while (parent[face] != face) face = parent[face];
    return face;
  };
  std::vector<Box3> boxes;
  for (const Face& face : faces) boxes.push_back(face.bounds().expanded(kSameLength));
  for (std::size_t j = 0; j < faces.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const std::size_t a = first_of(i), b = first_of(j);
      if (a == b || !overlap(boxes[i], boxes[j]) || !same_surface(faces[i], faces[j])) continue;
      if (!BorderWalk(faces[i], faces[j]).meets() && !BorderWalk(faces[j], faces[i]).meets()) continue;
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].shape == Face::Shape::kVolume) {
      faces[i].surface = 0;
    } else {
      faces[i].surface = parent[i] == i ? ++last : faces[first_of(i)].surface;
    }
  }
}

}  // namespace arris::synth
