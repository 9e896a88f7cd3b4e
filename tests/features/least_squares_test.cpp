#include "features/numerics/least_squares.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Dense>

#include "ball_testing.h"

namespace arris {
namespace {

constexpr int kN = 5;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, kN>;

RC_GTEST_PROP(LeastSquares, AnyRegressors_SolvedAsEigenDoes, (std::uint64_t seed)) {
  test::Random random(seed);
  Matrix a(40, kN);
  Eigen::VectorXd w(40);
  for (int i = 0; i < a.rows(); ++i) {
    for (int j = 0; j < kN; ++j) a(i, j) = j == 0 ? 1.0 : random.in(-5.0, 5.0);
    w(i) = random.in(-2.0, 2.0);
  }
  const int size = *rc::gen::inRange(1, kN + 1);
  double m[kN][kN], y[kN], x[kN] = {};
  for (int i = 0; i < kN; ++i) {
    y[i] = a.col(i).dot(w);
    for (int j = 0; j < kN; ++j) m[i][j] = j <= i ? a.col(i).dot(a.col(j)) : 1e300;  // The upper half is not read.
  }
  double variance = 0.0;
  RC_ASSERT(solve_normal_equations<kN>(m, y, size, x, variance));
  const Eigen::MatrixXd part = a.leftCols(size);
  const Eigen::VectorXd expected = part.colPivHouseholderQr().solve(w);
  for (int i = 0; i < size; ++i) RC_ASSERT(std::fabs(x[i] - expected(i)) < 1e-10);
  const double of_inverse = (part.transpose() * part).inverse()(size - 1, size - 1);
  RC_ASSERT(std::fabs(variance - of_inverse) < 1e-9 * of_inverse);
}

TEST(LeastSquares, DependentRegressors_AreRefused) {
  const double y[2] = {1.0, 2.0};
  double x[2], variance;
  const double twice[2][2] = {{4.0, 0.0}, {8.0, 16.0}};
  EXPECT_FALSE(solve_normal_equations<2>(twice, y, 2, x, variance));
  const double nothing[2][2] = {};
  EXPECT_FALSE(solve_normal_equations<2>(nothing, y, 2, x, variance));
  EXPECT_TRUE(solve_normal_equations<2>(twice, y, 1, x, variance)) << "the first alone is independent";
  EXPECT_DOUBLE_EQ(x[0], 0.25);
}

}  // namespace
}  // namespace arris
