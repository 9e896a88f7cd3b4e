#pragma once
/// @file The points around a few neighbouring queries, gathered once and kept contiguous for the kernels.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/pages.h"
#include "features/neighbourhood/candidate_products.h"
#include "features/neighbourhood/point_tree.h"
#include "features/numerics/simd.h"

namespace arris {

/// Largest reach in steps that any query may have.
constexpr double kMostReach = 1073741824.0;  // 2^30

/// Squares of integers below this are exact in T.
template <class T>
constexpr double kExactSquares = 0.0;
template <>
inline constexpr double kExactSquares<float> = 16777216.0;  // 2^24
template <>
inline constexpr double kExactSquares<double> = 9007199254740992.0;  // 2^53
template <>
inline constexpr double kExactSquares<std::int64_t> = 9.2e18;  // Just below 2^63.

/// Keeps squares of int64 differences from overflowing: what is cut is beyond every reach (kMostReach) and stays so.
template <class T>
ARRIS_ALWAYS_INLINE T bounded(T difference) {
  if constexpr (std::is_same_v<T, std::int64_t>) {
    return std::clamp(difference, std::int64_t{-1500000000}, std::int64_t{1500000000});
  } else {
    return difference;
  }
}

/// All that is told of one candidate, in one piece: fewer reads for those that few queries ask for.
struct alignas(16) PackedCandidate {
  float x, y, z;
  std::uint32_t slot;
};

/// Candidates as structure of arrays relative to `origin`. `T` is float, double or std::int64_t; coordinates are exact
/// in it.
template <class T>
struct CandidateSet {
  PageVector<T> x, y, z;
  PageVector<std::uint32_t> slot;  ///< Index in tree order.
  std::size_t count = 0;
  std::int64_t origin[3] = {0, 0, 0};
  double farthest = 0.0;               ///< No coordinate is farther from 0.
  CandidateProducts products;          ///< For ball_moments(), where asked for.
  PageVector<PackedCandidate> packed;  ///< For select_nearest(), where asked for.

  /// Every point within `reach` steps of `box`, and some more: complete for queries inside the box up to that distance.
  /// Arrays are padded to a multiple of simd::kPadding with points far outside of any reach. Returns false, with no
  /// meaningful content, if a coordinate is not exact in T: the caller takes a wider type. O(points in the buckets that
  /// the reach touches).
  bool gather(const PointTree& tree, const ClosedBox& box, double reach);
  /// Makes the products of what was gathered: worth it for the moments of several balls. Only floats have them.
  void multiply();
  /// Makes `packed` of what was gathered: for select_nearest(). Only floats have it.
  void pack();

 private:
  void make_room(std::size_t size);
  bool is_exact_in(const PointTree& tree) const;

  std::vector<std::uint32_t> buckets_;  ///< That the reach touches.
};

}  // namespace arris
