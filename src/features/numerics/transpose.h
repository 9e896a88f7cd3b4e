#pragma once
/// @file Rows to columns, in registers.

#include <cstddef>
#include <utility>

#include "features/numerics/simd.h"

namespace arris::simd {

namespace detail {

template <std::size_t Half, class V, std::size_t... Lane>
ARRIS_ALWAYS_INLINE void swap_halves(V& a, V& b, std::index_sequence<Lane...>) {
  constexpr std::size_t kLanes = sizeof...(Lane);
  const V low = __builtin_shufflevector(a, b, static_cast<int>((Lane & Half) != 0 ? kLanes + Lane - Half : Lane)...);
  b = __builtin_shufflevector(a, b, static_cast<int>((Lane & Half) != 0 ? kLanes + Lane : Lane + Half)...);
  a = low;
}

template <std::size_t Half, std::size_t Lanes, class V>
ARRIS_ALWAYS_INLINE void transpose_from(V* rows) {
  if constexpr (Half < Lanes) {
    ARRIS_UNROLL
    for (std::size_t i = 0; i < Lanes; ++i) {
      if ((i & Half) == 0) swap_halves<Half>(rows[i], rows[i + Half], std::make_index_sequence<Lanes>());
    }
    transpose_from<2 * Half, Lanes>(rows);
  }
}

}  // namespace detail

/// rows[i][j] becomes rows[j][i], for as many rows as a vector has lanes.
template <std::size_t Lanes, class V>
ARRIS_ALWAYS_INLINE void transpose(V* rows) {
  static_assert(sizeof(V) == Lanes * sizeof(rows[0][0]));
  detail::transpose_from<1, Lanes>(rows);
}

}  // namespace arris::simd
