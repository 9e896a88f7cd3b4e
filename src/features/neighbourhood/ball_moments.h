#pragma once
/// @file Exact moments of the points within a ball, and how far they spread along a direction.

#include <array>
#include <cstddef>

#include "features/neighbourhood/candidate_set.h"
#include "features/numerics/symmetric_eigen3.h"

namespace arris {

template <class T>
struct BallQuery {
  T x, y, z;  ///< Centre relative to the candidates' origin.
  T radius2;  ///< floor(r²) in steps², exact in T: membership is d² <= radius2.
};

/// Sums over the members relative to the centre; the sums are exact integers (rounded once to double where above 2^53).
struct BallMoments {
  double n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  /// Covariance with factor 1/n, steps².
  SymmetricMatrix<double> covariance() const;
};

/// True if ball_moments are exact for a ball of `radius` steps whose squares are exact in T: always for float, whose
/// sums are made in double where they must.
template <class T>
bool ball_sums_are_exact(double radius);

/// Law: bits do not depend on the order of the candidates. Needs ball_sums_are_exact (always true for int64, the slow
/// exact path).
template <class T>
BallMoments ball_moments(const CandidateSet<T>& candidates, const BallQuery<T>& ball);

/// How far the members extend along a direction, steps: no evaluation in double leaves these bounds.
struct ExtentBounds {
  double least = 0.0, most = 0.0;
};
/// Along the unit vectors e and f.
template <class T>
std::array<ExtentBounds, 2> extent_bounds(const CandidateSet<T>& candidates, const BallQuery<T>& ball, const Vector3& e,
                                          const Vector3& f);

}  // namespace arris
