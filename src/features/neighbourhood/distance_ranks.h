#pragma once
/// @file Which of many distances is the how-manieth.

#include <cstddef>
#include <cstdint>

namespace arris {

/// More than this many have no ranks; about there a comparison sort begins to beat counting.
constexpr std::size_t kMostRanked = 128;

/// rank[i] = how many of the n <= kMostRanked values are smaller than values[i], or equal and further in front. Returns
/// whether some are equal. O(n²/16).
/// @param values  float or double, whole numbers with exact squares (kExactSquares). Up to simd::padded(n) of them are
/// read, and as many ranks written.
template <class T>
bool rank_distances(const T* values, std::size_t n, std::int32_t* rank);

}  // namespace arris
