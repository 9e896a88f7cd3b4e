#pragma once
/// @file The integer lattice: the one coordinate system in which everything is analysed.
///
/// All analysis happens on int32 steps of one global lattice. Differences of lattice coordinates are exact, so no
/// result can depend on the origin of a tile. Tiles, voxels and cells sit on multiples counted from the lattice origin,
/// never on the bounding box of the data. Boxes are half-open, so that every point has exactly one owner.

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>

namespace arris {

/// A point in lattice steps.
struct LatticePoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
  std::int32_t operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

/// Exact squared distance in steps² where it is below 2^64, as along one axis it always is.
inline std::uint64_t squared_distance(const LatticePoint& a, const LatticePoint& b) {
  // The square of a difference of 2^32 - 1 has no room in int64; modulo 2^64 it is the same without a sign.
  const auto square = [](std::int32_t from, std::int32_t to) {
    const auto difference = static_cast<std::uint64_t>(std::int64_t{from} - to);
    return difference * difference;
  };
  return square(a.x, b.x) + square(a.y, b.y) + square(a.z, b.z);
}

/// A half-open box [min, max) in lattice steps; int64 because max may be 2^31. Empty when any side is not positive.
struct LatticeBox {
  std::array<std::int64_t, 3> min{0, 0, 0};
  std::array<std::int64_t, 3> max{0, 0, 0};

  friend bool operator==(const LatticeBox&, const LatticeBox&) = default;

  bool empty() const { return max[0] <= min[0] || max[1] <= min[1] || max[2] <= min[2]; }
  bool contains(const LatticePoint& p) const {
    return p.x >= min[0] && p.x < max[0] && p.y >= min[1] && p.y < max[1] && p.z >= min[2] && p.z < max[2];
  }
  bool intersects(const LatticeBox& o) const {
    return min[0] < o.max[0] && o.min[0] < max[0] && min[1] < o.max[1] && o.min[1] < max[1] && min[2] < o.max[2] &&
           o.min[2] < max[2];
  }
  LatticeBox expanded(std::int64_t steps) const {
    LatticeBox box = *this;
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] -= steps;
      box.max[axis] += steps;
    }
    return box;
  }
  /// The same box, but unlimited on the sides on which it reaches the border of `bounds`: what lies beyond is known to
  /// be empty.
  LatticeBox unlimited_beyond(const LatticeBox& bounds) const;
  /// Grows the box so that it contains p (an empty default box becomes the one point).
  void include(const LatticePoint& p);
  void include(const LatticeBox& box);
  /// Distance in steps from an inside point to the nearest lattice position *outside* the box. A ball around p whose
  /// radius is smaller than this has no unseen lattice position; 0 if p is outside.
  std::int64_t depth(const LatticePoint& p) const;
};

/// Maps lattice steps to world coordinates: world = origin + step * index, per axis.
struct Lattice {
  double step = 0.0001;                         ///< Length of one step in data units, the same on all axes, > 0.
  std::array<double, 3> origin{0.0, 0.0, 0.0};  ///< World coordinates of index 0.

  double world(int axis, std::int64_t index) const { return origin[axis] + step * static_cast<double>(index); }
  /// Nearest lattice index of a finite world coordinate, half away from zero; may lie outside int32, the caller checks.
  std::int64_t index(int axis, double world) const;
};

}  // namespace arris
