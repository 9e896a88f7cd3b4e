#pragma once
/// @file One edge of the truth: a straight segment or a circular arc, with its exact distance function.

#include <cstdint>
#include <string>

#include "evaluate/edge_kind.h"
#include "evaluate/vec3.h"

namespace arris::evaluate {

/// Lengths in data units. Laws: (1) distance(point_at(t)) is 0 up to rounding for t in [0, 1]; (2) |distance(p) -
/// distance(q)|
/// <= |p - q|; (3) point_at moves at constant speed: the piece between t0 and t1 is (t1 - t0) * length() long.
struct TruthEdge {
  enum class Shape : std::uint8_t { kSegment, kArc };

  EdgeKind kind = EdgeKind::kBoundary;
  Shape shape = Shape::kSegment;
  std::string role;  ///< What a surveyor calls it: "ridge", "eave", "hole"; letters, digits and '_' only, may be empty.
  double angle_deg = 0.0;  ///< Angle between the two faces, (0, 180) for convex and concave alike; 0 for boundaries.
  Vec3 a;                  ///< Segment: first end. Arc: centre.
  Vec3 b;                  ///< Segment: second end. Arc: unit axis.
  Vec3 start;  ///< Arc: from the centre to its first point, perpendicular to the axis; its length is the radius.
  double sweep_deg = 0.0;  ///< Arc: counter-clockwise about the axis, (0, 360]; 360 is a full circle.

  double spacing = 0.0;      ///< Of the points beside the edge, sqrt(area per point), >= 0; 0: not known.
  double spacing_max = 0.0;  ///< In the direction in which they are farther apart, >= 0; 0: not known.

  friend bool operator==(const TruthEdge&, const TruthEdge&) = default;

  double length() const;
  /// @param fraction  [0, 1] of the length.
  Vec3 point_at(double fraction) const;
  /// Exact Euclidean distance to the edge (not to samples of it).
  double distance(const Vec3& point) const;
  /// True if the edge has no ends.
  bool closed() const { return shape == Shape::kArc && sweep_deg >= 360.0; }
};

TruthEdge make_segment(EdgeKind kind, std::string role, const Vec3& from, const Vec3& to, double angle_deg = 0.0);
/// A full circle. @param axis  any length > 0.
TruthEdge make_circle(EdgeKind kind, std::string role, const Vec3& centre, const Vec3& axis, double radius,
                      double angle_deg = 0.0);

}  // namespace arris::evaluate
