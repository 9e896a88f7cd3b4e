#pragma once
/// @file Normal equations of a few unknowns.

#include <cmath>

namespace arris {

/// Solves M x = y for the first `size` unknowns by Cholesky's method; only the lower triangle of the symmetric M is
/// read.
/// @param last_variance  variance of the last unknown in units of the residuals' variance.
/// @return false if the equations are dependent.
template <int N>
bool solve_normal_equations(const double (&m)[N][N], const double (&y)[N], int size, double (&x)[N],
                            double& last_variance) {
  double l[N][N] = {};
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i != j) {
        l[i][j] = sum / l[j][j];
        continue;
      }
      if (!(sum > 1e-9 * m[i][i])) return false;
      l[i][i] = std::sqrt(sum);
    }
  }
  double z[N];
  for (int i = 0; i < size; ++i) {
    double sum = y[i];
    for (int k = 0; k < i; ++k) sum -= l[i][k] * z[k];
    z[i] = sum / l[i][i];
  }
  for (int i = size - 1; i >= 0; --i) {
    double sum = z[i];
    for (int k = i + 1; k < size; ++k) sum -= l[k][i] * x[k];
    x[i] = sum / l[i][i];
  }
  last_variance = 1.0 / (l[size - 1][size - 1] * l[size - 1][size - 1]);
  return true;
}

}  // namespace arris
