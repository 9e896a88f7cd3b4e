#pragma once
/// @file Normal equations of a few unknowns.

#include <cmath>

namespace arris {

/// Cholesky's factor of a symmetric matrix, of which the lower triangle is read. The factor of the first unknowns is
/// part of that of all: one serves models of several sizes.
template <int N>
class CholeskyFactor {
 public:
  explicit CholeskyFactor(const double (&m)[N][N], int size = N) {
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j <= i; ++j) {
        double sum = m[i][j];
        for (int k = 0; k < j; ++k) sum -= l_[i][k] * l_[j][k];
        if (i != j) {
          l_[i][j] = sum / l_[j][j];
          continue;
        }
        if (!(sum > 1e-9 * m[i][i])) return;
        l_[i][i] = std::sqrt(sum);
      }
      independent_ = i + 1;
    }
  }

  /// So many of the first unknowns do not depend on each other.
  int independent() const { return independent_; }

  /// Solves for the first `size` unknowns, at most independent().
  void solve(const double (&y)[N], int size, double (&x)[N]) const {
    double z[N];
    for (int i = 0; i < size; ++i) {
      double sum = y[i];
      for (int k = 0; k < i; ++k) sum -= l_[i][k] * z[k];
      z[i] = sum / l_[i][i];
    }
    for (int i = size - 1; i >= 0; --i) {
      double sum = z[i];
      for (int k = i + 1; k < size; ++k) sum -= l_[k][i] * x[k];
      x[i] = sum / l_[i][i];
    }
  }

  /// Variance of the last of `size` unknowns in units of the residuals' variance.
  double last_variance(int size) const { return 1.0 / (l_[size - 1][size - 1] * l_[size - 1][size - 1]); }

 private:
  double l_[N][N];
  int independent_ = 0;
};

/// Solves M x = y for the first `size` unknowns.
/// @param last_variance  variance of the last unknown in units of the residuals' variance.
/// @return false if the equations are dependent.
template <int N>
bool solve_normal_equations(const double (&m)[N][N], const double (&y)[N], int size, double (&x)[N],
                            double& last_variance) {
  const CholeskyFactor<N> factor(m, size);
  if (factor.independent() < size) return false;
  factor.solve(y, size, x);
  last_variance = factor.last_variance(size);
  return true;
}

}  // namespace arris
