#pragma once
/// @file Planes and cylinders as surfaces over two lengths (u, v). Private to synth.

#include <numbers>

#include "synth/deterministic_math.h"
#include "synth/scan_visibility.h"

namespace arris::synth {

/// Plane: (u, v) of the face's frame, also beyond the face. Cylinder: u metres round the axis, v metres along it.
inline SurfacePoint surface_at(const Face& face, std::uint32_t index, const Point2& p) {
  if (face.shape != Face::Shape::kCylinder) return {face.at(p.u, p.v), face.ew, index};
  const SinCos angle = sin_cos_turns(p.u / face.size_u);
  const Vec3 outward = angle.cos * face.eu + angle.sin * face.ev;
  return {face.origin + face.radius * outward + p.v * face.ew, outward, index};
}

/// The place of the surface (extended) next to a position near it.
inline SurfacePoint surface_near(const Face& face, std::uint32_t index, const Vec3& position) {
  const Vec3 local = position - face.origin;
  if (face.shape != Face::Shape::kCylinder) return {position - dot(local, face.ew) * face.ew, face.ew, index};
  const double along = dot(local, face.ew);
  const Vec3 outward = normalized(local - along * face.ew);
  return {face.origin + along * face.ew + face.radius * outward, outward, index};
}

inline bool owns(const Face& face, const Point2& p) {
  return face.shape == Face::Shape::kCylinder ? p.v >= 0.0 && p.v < face.size_v : face.owns(p.u, p.v);
}

/// True if a position on the extended surface belongs to the face.
inline bool owns(const Face& face, const Vec3& position) {
  const Vec3 local = position - face.origin;
  if (face.shape == Face::Shape::kCylinder) return owns(face, Point2{0.0, dot(local, face.ew)});
  return owns(face, Point2{dot(local, face.eu), dot(local, face.ev)});
}

}  // namespace arris::synth
