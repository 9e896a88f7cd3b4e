#pragma once
/// @file Tells balls that cannot be folds from their moments, eight at a time.

#include <array>
#include <cstddef>

#include "features/liu/fold_test.h"

namespace arris {

/// Not thread-safe.
class FoldScreen {
 public:
  static constexpr std::size_t kCount = 8;

  void set(std::size_t i, const BallMoments& m, const FoldThresholds& thresholds) {
    const double column[kInputs] = {m.n,           m.x, m.y, m.z, m.xx, m.xy, m.xz, m.yy, m.yz, m.zz, thresholds.radius,
                                    thresholds.cf1};
    for (std::size_t row = 0; row < kInputs; ++row) in_[row][i] = column[row];
  }
  /// Covariances and eigenvalues of all eight; those that were never set give anything.
  void solve();
  /// False if chord_deviation_bound() is below the threshold.
  bool may_fold(std::size_t i) const { return !(out_[9][i] < in_[11][i]); }
  double points(std::size_t i) const { return in_[0][i]; }
  /// As BallMoments::covariance().
  SymmetricMatrix<double> covariance(std::size_t i) const {
    return {out_[0][i], out_[1][i], out_[2][i], out_[3][i], out_[4][i], out_[5][i]};
  }
  Eigenvalues<double> values(std::size_t i) const { return {out_[6][i], out_[7][i], out_[8][i]}; }

 private:
  struct Kernel;
  static constexpr std::size_t kInputs = 12;
  static constexpr std::size_t kOutputs = 10;
  using Lanes = std::array<double, kCount>;
  alignas(64) std::array<Lanes, kInputs> in_{};
  alignas(64) std::array<Lanes, kOutputs> out_{};
};

}  // namespace arris
