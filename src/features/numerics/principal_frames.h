#pragma once
/// @file Principal frames of eight symmetric 3x3 matrices at once.

#include <array>
#include <cstddef>

#include "features/numerics/symmetric_eigen3.h"

namespace arris {

/// Law: the frames are those of principal_frame(), bit by bit, at every vector width. Not thread-safe.
class PrincipalFrames {
 public:
  static constexpr std::size_t kCount = 8;

  /// @param values  eigenvalues_of(a).
  void set(std::size_t i, const SymmetricMatrix<double>& a, const Eigenvalues<double>& values) {
    const double column[kInputs] = {a.xx, a.xy, a.xz, a.yy, a.yz, a.zz, values.largest, values.middle, values.smallest};
    for (std::size_t row = 0; row < kInputs; ++row) in_[row][i] = column[row];
  }
  /// Solves all eight; those that were never set give anything.
  void solve();
  PrincipalFrame frame(std::size_t i) const {
    const auto row = [&](std::size_t first) { return Vector3{out_[first][i], out_[first + 1][i], out_[first + 2][i]}; };
    return {{in_[6][i], in_[7][i], in_[8][i]}, row(0), row(3), row(6)};
  }

 private:
  struct Kernel;
  static constexpr std::size_t kInputs = 9;
  using Lanes = std::array<double, kCount>;
  alignas(64) std::array<Lanes, kInputs> in_{};
  alignas(64) std::array<Lanes, 9> out_{};
};

}  // namespace arris
