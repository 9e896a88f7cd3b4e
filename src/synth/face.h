#pragma once
/// @file The faces that scenes are made of: planes with holes, cylinders, spheres, and a volume of noise.

#include <cstdint>
#include <vector>

#include "evaluate/box_tree.h"
#include "evaluate/vec3.h"

namespace arris::synth {

using evaluate::Box3;
using evaluate::Vec3;

struct Point2 {
  double u = 0.0, v = 0.0;
};
struct Circle2 {
  Point2 centre;
  double radius = 0.0;
};
struct Rect2 {
  Point2 min, max;
};

/// How a face looks to a scanner.
struct Material {
  double reflectance = 0.5;         ///< (0, 1].
  std::uint8_t classification = 1;  ///< ASPRS code.
  std::uint16_t red = 0x8000, green = 0x8000, blue = 0x8000;
};

/// One face. eu, ev, ew are orthonormal and right-handed.
///
/// kPlane: origin + u eu + v ev for (u, v) in [0, size_u] x [0, size_v], cut to `outline` or `disc` if given, less the
/// holes; ew is the normal. A disc may be a ring or a sector. kCylinder: lateral surface about the axis ew from origin
/// to origin + size_v ew, u runs round it from eu. kSphere: centre `origin`, cut to the cap above a height along ew.
/// kVolume: the box [0, size_u] x [0, size_v] x [0, size_w] from origin, or the ellipsoid inscribed in it, filled.
struct Face {
  enum class Shape : std::uint8_t { kPlane, kCylinder, kSphere, kVolume };

  Shape shape = Shape::kPlane;
  Vec3 origin, eu{1, 0, 0}, ev{0, 1, 0}, ew{0, 0, 1};
  double size_u = 0.0, size_v = 0.0, size_w = 0.0;
  double radius = 0.0;                ///< Cylinder, sphere and disc.
  double inner_radius = 0.0;          ///< Disc: the face is the ring outside of it.
  double sweep_turns = 1.0;           ///< Disc and cylinder: the part of the full turn from eu towards ev, (0, 1].
  Point2 sweep_end{1.0, 0.0};         ///< cos and sin of sweep_turns; see set_sweep().
  double cap_height = -1e300;         ///< Sphere: the face is where the height over the centre is at least this.
  std::vector<Point2> outline;        ///< Plane: simple polygon within the rectangle; empty: the whole rectangle.
  bool disc = false;                  ///< Plane: the circle inscribed in the (square) rectangle.
  std::vector<Circle2> circle_holes;  ///< Plane: disjoint holes inside the outline.
  std::vector<Rect2> rect_holes;
  bool ellipsoid = false;  ///< Volume.
  /// Volume: points per spacing² of a beam along ew through the whole box; 0: one per spacing³.
  double returns = 0.0;
  Material material;
  int material_number = 1;  ///< Parts of one plane that differ in it are surfaces of their own.
  /// Number of the surface that it is a part of, from 1; 0 for volumes, and until number_surfaces() has set it.
  std::uint32_t surface = 0;

  Vec3 at(double u, double v) const { return origin + u * eu + v * ev; }
  /// Scanned scenes take full cylinders only.
  void set_sweep(double turns);
  /// True if the direction (u, v) from the axis or the disc's centre is within the sweep.
  bool in_sweep(double u, double v) const;
  /// True if (u, v) of the rectangle belongs to the plane. Outlines and holes are half-open: no seam is owned twice.
  bool owns(double u, double v) const;
  /// True if the volume holds a place of its box.
  bool fills(double u, double v, double w) const;
  /// Area, or volume of kVolume. Data units squared, or cubed.
  double measure() const;
  /// Exact distance of a point to the face (to the filled box for kVolume).
  double distance(const Vec3& point) const;
  Box3 bounds() const;
};

}  // namespace arris::synth
