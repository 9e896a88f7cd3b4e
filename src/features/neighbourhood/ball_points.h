#pragma once
/// @file The points of one ball in units of the local spacing, on a grid so fine that nobody notices and so coarse that
/// sums are exact.

#include <cmath>
#include <cstddef>

#include "core/pages.h"
#include "features/neighbourhood/ball_moments.h"
#include "features/neighbourhood/candidate_set.h"
#include "features/numerics/simd.h"

namespace arris {

/// Rounds to a multiple of 2^-bits, half to even; |value| < 2^(51 - bits).
template <int Bits, class V>
ARRIS_ALWAYS_INLINE V on_grid(const V& value) {
  constexpr double kMagic = 1.5 * static_cast<double>(std::uint64_t{1} << (52 - Bits));
  return (value + kMagic) - kMagic;
}

/// Coordinates are multiples of 2^-kCoordinateBits spacings.
constexpr int kCoordinateBits = 9;
/// Balls have at most this radius in spacings: a square then needs 26 bits, and a sum of 2^26 of them is exact.
constexpr double kLargestBall = 15.0;

/// Positions relative to the ball's centre (which is one of the points), in spacings; any order. Padded to a multiple
/// of simd::kPadding with points whose coordinates are all kPaddingCoordinate.
struct BallPoints {
  static constexpr double kPaddingCoordinate = 1024.0;

  PageVector<double> x, y, z;
  std::size_t count = 0;

  std::size_t padded_count() const { return simd::padded(count); }
  /// Makes room for `most` points and a vector more; keeps what is there.
  void make_room(std::size_t most);
  /// Sets the number of points and pads the arrays.
  void finish(std::size_t points);
};

/// The members of `ball` divided by `spacing` (steps, > 0; the ball's radius is at most kLargestBall of it). A
/// function of the set of members alone, but for their order. Tiny spacings beside the lattice's steps lose nothing:
/// coordinates are rounded after the division.
template <class T>
void collect_ball(const CandidateSet<T>& candidates, const BallQuery<T>& ball, double spacing, BallPoints& points);

/// The points within `radius` spacings of the centre.
void keep_within(const BallPoints& points, double radius, BallPoints& kept);

}  // namespace arris
