#pragma once
/// @file Rows to columns.

#include <cstddef>

#include "features/numerics/simd.h"

namespace arris::simd {

namespace detail {

/// Of rows a and b that are `kApart` apart, exchanges the elements that are on the wrong side.
template <class V, std::size_t kApart>
ARRIS_ALWAYS_INLINE void exchange(V& a, V& b) {
  constexpr std::size_t kLanes = sizeof(V) / sizeof(double);
  typename Wide<sizeof(V)>::Long first, second;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const bool low = (lane & kApart) == 0;
    first[lane] = static_cast<std::int64_t>(low ? lane : kLanes + lane - kApart);
    second[lane] = static_cast<std::int64_t>(low ? lane + kApart : kLanes + lane);
  }
  const V new_a = __builtin_shuffle(a, b, first);
  b = __builtin_shuffle(a, b, second);
  a = new_a;
}

template <class V, std::size_t kApart>
ARRIS_ALWAYS_INLINE void exchange_all(V* rows) {
  constexpr std::size_t kLanes = sizeof(V) / sizeof(double);
  ARRIS_UNROLL
  for (std::size_t i = 0; i < kLanes; ++i)
    if ((i & kApart) == 0) exchange<V, kApart>(rows[i], rows[i + kApart]);
  if constexpr (2 * kApart < kLanes) exchange_all<V, 2 * kApart>(rows);
}

}  // namespace detail

/// A square block of doubles, as many rows as V has lanes. @param from_stride, to_stride  from one row to the next.
template <class V>
ARRIS_ALWAYS_INLINE void transpose(const double* from, std::size_t from_stride, double* to, std::size_t to_stride) {
  constexpr std::size_t kLanes = sizeof(V) / sizeof(double);
  V rows[kLanes];
  ARRIS_UNROLL
  for (std::size_t i = 0; i < kLanes; ++i) rows[i] = load<V>(from + i * from_stride);
  detail::exchange_all<V, 1>(rows);
  ARRIS_UNROLL
  for (std::size_t i = 0; i < kLanes; ++i) store(to + i * to_stride, rows[i]);
}

}  // namespace arris::simd
