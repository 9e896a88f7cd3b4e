#pragma once
/// @file A frame in a plane in which lattice positions have exact coordinates.

#include <cstdint>

#include "features/numerics/symmetric_eigen3.h"

namespace arris {

/// u and v span the plane, n is its normal; u, v, n is right-handed. Law: the components are multiples of
/// 2^-kFrameBits, so that for lattice differences of up to 2^33 steps per axis every dot product is exact in double, in
/// any order: coordinates may be taken relative to any origin and subtracted, the result depends on the two points
/// only. The price: the frame is orthonormal to kFrameError only.
struct PlaneFrame {
  Vector3 u{0, 0, 0}, v{0, 0, 0}, n{0, 0, 0};
};

constexpr int kFrameBits = 18;
/// Lengths and right angles are kept to this, with room to spare.
constexpr double kFrameError = 1e-4;

/// @param normal  unit vector. A function of it up to its sign: (u, v, n) and (u, -v, -n) are the same plane.
PlaneFrame plane_frame(const Vector3& normal);

/// A coordinate (a dot product with u, v or n) in units of 2^-kFrameBits steps: exact.
inline std::int64_t frame_units(double coordinate) {
  return static_cast<std::int64_t>(coordinate * static_cast<double>(std::int64_t{1} << kFrameBits));
}

}  // namespace arris
