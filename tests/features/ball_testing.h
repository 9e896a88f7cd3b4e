#pragma once
/// @file Balls of points on analytic surfaces, in spacings around a centre, as the method's pieces see them.

#include <cstdint>
#include <random>
#include <vector>

#include "features/neighbourhood/ball_points.h"
#include "features/numerics/symmetric_eigen3.h"

namespace arris::test {

/// The same numbers with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }  ///< [0, 1).
  double in(double low, double high) { return low + (high - low) * unit(); }
  double normal();  ///< Nearly: the sum of twelve.
  std::uint64_t below(std::uint64_t end) { return bits_() % end; }

 private:
  std::mt19937_64 bits_;
};

/// In place; the same permutation with every standard library.
template <class T>
void shuffle(std::vector<T>& values, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random.below(i)]);
}

/// The points within `radius` of the origin, through collect_ball: rounded to its grid.
BallPoints ball_of(const std::vector<Vector3>& points, double radius = 15.0);

/// A rotation of all points about the origin; rows are unit vectors.
using Rotation = std::array<Vector3, 3>;
Rotation any_rotation(std::uint64_t seed);
Vector3 rotated(const Rotation& rotation, const Vector3& p);
void rotate(const Rotation& rotation, std::vector<Vector3>& points);
/// Isotropic, `noise` is the standard deviation in spacings.
void disturb(std::vector<Vector3>& points, double noise, std::uint64_t seed);

/// One point per unit square of the plane z = 0, jittered by half a spacing in all, with |x|, |y| <= 16.
std::vector<Vector3> plane_points(std::uint64_t seed);
/// Two half planes that meet in the line through (0, 0, 0) along x and enclose `angle_deg`; they open towards +z.
std::vector<Vector3> fold_points(double angle_deg, std::uint64_t seed);
/// Two sheets z = 0 and z = gap.
std::vector<Vector3> layer_points(double gap, std::uint64_t seed);
/// A vertical cylinder wall of `radius` around the axis (0, -radius), z in [-16, 0], closed by its cap z = 0: the rim
/// passes the origin along x.
std::vector<Vector3> rim_points(double radius, std::uint64_t seed);
/// A cylinder of `radius` along x through the origin, open towards -z: a column's wall.
std::vector<Vector3> column_points(double radius, std::uint64_t seed);

std::vector<Vector3> moved(std::vector<Vector3> points, const Vector3& by);

}  // namespace arris::test
