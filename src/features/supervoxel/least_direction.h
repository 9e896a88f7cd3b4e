#pragma once
/// @file Eigenvalues and the vector of the smallest one for eight symmetric 3x3 matrices at once.

#include <array>
#include <cstddef>

#include "features/numerics/symmetric_eigen3.h"

namespace arris {

/// The same bits at every vector width. Not thread-safe.
class LeastDirections {
 public:
  static constexpr std::size_t kCount = 8;

  void set(std::size_t i, const SymmetricMatrix<double>& a) {
    xx_[i] = a.xx;
    xy_[i] = a.xy;
    xz_[i] = a.xz;
    yy_[i] = a.yy;
    yz_[i] = a.yz;
    zz_[i] = a.zz;
  }
  /// Solves all eight; those that were never set give anything.
  void solve();
  Eigenvalues<double> values(std::size_t i) const { return {largest_[i], middle_[i], smallest_[i]}; }
  /// As kernel_vector(a, smallest): unit, or not finite where the matrix is a multiple of the identity.
  Vector3 direction(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }

 private:
  struct Kernel;
  using Lanes = std::array<double, kCount>;
  alignas(64) Lanes xx_{}, xy_{}, xz_{}, yy_{}, yz_{}, zz_{};
  alignas(64) Lanes largest_{}, middle_{}, smallest_{}, x_{}, y_{}, z_{};
};

}  // namespace arris
