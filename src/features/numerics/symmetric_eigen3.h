#pragma once
/// @file Eigenvalues and eigenvectors of symmetric 3x3 matrices in closed form, one at a time or eight at once.
///
/// Scale-free: entries may be any finite doubles whose sixth power neither overflows nor underflows. Laws: (1) bits
/// depend on the six entries only; (2) values are descending; (3) the frame is orthonormal to 1e-14 and right-handed,
/// whatever the matrix. Source: trigonometric solution of the characteristic cubic with Newton steps instead of
/// cos(acos(r)/3); frame after D. Eberly, "A Robust Eigensolver for 3x3 Symmetric Matrices" (2014): the best separated
/// vector first, then a 2x2 problem.

#include <array>

#include "features/numerics/simd.h"

namespace arris {

template <class V>
struct SymmetricMatrix {
  V xx, xy, xz, yy, yz, zz;
};

template <class V>
struct Eigenvalues {
  V largest, middle, smallest;
};

/// Absolute error of the values: about 1e-15 of the largest magnitude; 1e-8 of it for the gap between two nearly equal
/// values.
template <class V>
ARRIS_ALWAYS_INLINE Eigenvalues<V> eigenvalues_of(const SymmetricMatrix<V>& a) {
  const V zero = a.xx - a.xx;
  const V mean = (a.xx + a.yy + a.zz) * (1.0 / 3.0);
  const V bx = a.xx - mean;
  const V by = a.yy - mean;
  const V bz = a.zz - mean;
  const V off = a.xy * a.xy + a.xz * a.xz + a.yz * a.yz;
  const V p2 = (bx * bx + by * by + bz * bz + 2.0 * off) * (1.0 / 6.0);
  const V p = simd::square_root(p2);
  const V det = bx * (by * bz - a.yz * a.yz) - a.xy * (a.xy * bz - a.yz * a.xz) + a.xz * (a.xy * a.yz - by * a.xz);
  const V p3 = p2 * p;
  const V r = p3 > 0.0 ? 0.5 * det / p3 : zero;
  V size = r < 0.0 ? -r : r;
  size = size > 1.0 ? zero + 1.0 : size;
  // t = cos(acos(size) / 3) is the root of 4 t^3 - 3 t = size in [cos(pi/6), 1]; three Newton steps from within 0.003
  // of it.
  V t = 0.86602540378443864676 + size * (1.0 / 6.0 - 0.03269207045110531343 * size);
  for (int step = 0; step < 3; ++step) {
    const V tt = t * t;
    t = (8.0 * tt * t + size) / (12.0 * tt - 3.0);
  }
  V sine2 = 1.0 - t * t;
  sine2 = sine2 < 0.0 ? zero : sine2;
  const V half_gap = 1.7320508075688772935 * p * simd::square_root(sine2);
  const V extreme = 2.0 * p * t;
  const V middle = p * t;
  // r >= 0: the largest value stands apart; r < 0: the smallest one does.
  const V first = r < 0.0 ? mean + middle + half_gap : mean + extreme;
  const V second = r < 0.0 ? mean + middle - half_gap : mean - middle + half_gap;
  const V third = r < 0.0 ? mean - extreme : mean - middle - half_gap;
  return {first, second, third};
}

using Vector3 = std::array<double, 3>;

inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Unit vector in the kernel of a - value * I, where `value` is well apart from the other two eigenvalues; (1, 0, 0)
/// where none of it is determined.
Vector3 kernel_vector(const SymmetricMatrix<double>& a, double value);

/// Principal frame: e1, e2, e3 belong to the values in descending order; e3 = e1 x e2. Signs follow from the entries by
/// a fixed rule; nothing may depend on them.
struct PrincipalFrame {
  Eigenvalues<double> values;
  Vector3 e1, e2, e3;
};

/// Any finite matrix; multiples of the identity give the coordinate axes.
/// @param values  eigenvalues_of(a).
PrincipalFrame principal_frame(const SymmetricMatrix<double>& a, const Eigenvalues<double>& values);
inline PrincipalFrame principal_frame(const SymmetricMatrix<double>& a) {
  return principal_frame(a, eigenvalues_of(a));
}

}  // namespace arris
