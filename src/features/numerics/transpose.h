#pragma once
/// @file Rows to columns.

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

/// In registers: rows[i][j] becomes rows[j][i], for as many rows as a vector has lanes.
template <std::size_t Lanes, class V>
ARRIS_ALWAYS_INLINE void transpose(V* rows) {
  static_assert(sizeof(V) == Lanes * sizeof(rows[0][0]));
  detail::transpose_from<1, Lanes>(rows);
}

/// A square block of doubles, as many rows as V has lanes. @param from_stride, to_stride  from one row to the next.
template <class V>
ARRIS_ALWAYS_INLINE void transpose(const double* from, std::size_t from_stride, double* to, std::size_t to_stride) {
  constexpr std::size_t kLanes = sizeof(V) / sizeof(double);
  V rows[kLanes];
  ARRIS_UNROLL
  for (std::size_t i = 0; i < kLanes; ++i) rows[i] = load<V>(from + i * from_stride);
  transpose<kLanes>(rows);
  ARRIS_UNROLL
  for (std::size_t i = 0; i < kLanes; ++i) store(to + i * to_stride, rows[i]);
}

}  // namespace arris::simd
