#pragma once
/// @file Batcher's merge exchange: compare-exchanges that sort, whatever the values are.

#include <algorithm>
#include <cstddef>

namespace arris {

/// Calls exchange(low, high) for every pair of places of n values, in order: each puts the smaller of the two values to
/// `low`. (Knuth, The Art of Computer Programming 3, algorithm 5.2.2 M.)
template <class Exchange>
constexpr void for_each_merge_exchange(std::size_t n, Exchange&& exchange) {
  for (std::size_t p = 1; p < n; p *= 2) {
    for (std::size_t k = p; k >= 1; k /= 2) {
      for (std::size_t j = k % p; j + k < n; j += 2 * k) {
        for (std::size_t i = j; i < std::min(j + k, n - k); ++i) {
          if (i / (2 * p) == (i + k) / (2 * p)) exchange(i, i + k);
        }
      }
    }
  }
}

}  // namespace arris
