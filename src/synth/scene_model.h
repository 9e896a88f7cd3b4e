#pragma once
/// @file The geometry of a scene while it is being put together: faces and the edges between them.

#include <initializer_list>
#include <string>
#include <vector>

#include "evaluate/truth_edge.h"
#include "synth/face.h"

namespace arris::synth {

using evaluate::EdgeKind;
using evaluate::TruthEdge;

/// Where a scanner stands; only scenes that are scanned have any.
struct ScannerStation {
  Vec3 position;
};

struct SceneModel {
  std::vector<Face> faces;
  std::vector<TruthEdge> edges;
  std::vector<ScannerStation> stations;
  double spray_share = 0.0;      ///< Least share of outliers, [0, 1).
  double intensity_noise = 0.0;  ///< Standard deviation of the intensity, share of it, [0, 1].
  double spray_reach = 0.0;      ///< Metres around the faces' box in which outliers are; 0: 10 % of its longest side.

  /// The rectangle with corner `a` and sides a-b and a-d (perpendicular); its normal is (b - a) x (d - a). The
  /// reference is valid until the next face is added.
  Face& rectangle(const Vec3& a, const Vec3& b, const Vec3& d, const Material& material);
  /// A planar simple polygon; u runs along its first side. The first two sides must not be parallel.
  Face& polygon(const std::vector<Vec3>& vertices, const Material& material);
  Face& disc(const Vec3& centre, const Vec3& normal, double radius, const Material& material);
  Face& cylinder(const Vec3& base, const Vec3& axis, double height, double radius, const Material& material);

  /// The part of a cylinder from the direction `start` on, counter-clockwise about the axis; `start` is perpendicular
  /// to the axis.
  /// @param axis  its length is the height. @param start  its length is the radius.
  Face& cylinder_part(const Vec3& base, const Vec3& axis, const Vec3& start, double turns, const Material& material);
  /// The part of a ring between two radii; `start` points from the centre along its first side, its length is the outer
  /// radius.
  Face& ring_part(const Vec3& centre, const Vec3& normal, const Vec3& start, double inner_radius, double turns);

  void segment(EdgeKind kind, const std::string& role, const Vec3& from, const Vec3& to, double angle_deg = 0.0);
  /// A closed polyline of segments of one kind.
  void loop(EdgeKind kind, const std::string& role, const std::vector<Vec3>& vertices, double angle_deg = 0.0);
  void circle(EdgeKind kind, const std::string& role, const Vec3& centre, const Vec3& axis, double radius,
              double angle_deg = 0.0);
  /// @param start  from the centre to the first point. @param axis  unit.
  void arc(EdgeKind kind, const std::string& role, const Vec3& centre, const Vec3& axis, const Vec3& start,
           double sweep_deg, double angle_deg);

  Box3 bounds() const;
};

/// Angle, degrees, between two half-planes that meet in the line a-b and lead from it towards `into_1` and `into_2`
/// (vectors, not parallel to the line).
double dihedral_deg(const Vec3& a, const Vec3& b, const Vec3& into_1, const Vec3& into_2);

}  // namespace arris::synth
