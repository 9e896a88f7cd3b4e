#pragma once
/// @file Rows of four floats to columns.

#include <cstddef>
#include <utility>

#include "features/numerics/simd.h"

namespace arris::simd {

namespace detail {

template <class V, std::size_t... Lane>
ARRIS_ALWAYS_INLINE auto joined(const V& a, const V& b, std::index_sequence<Lane...>) {
  return __builtin_shufflevector(a, b, static_cast<int>(Lane)...);
}

/// Of the rows in a and b the first two columns, one after the other, and the last two.
template <class V, std::size_t... Lane>
ARRIS_ALWAYS_INLINE void part_pairs(const V& a, const V& b, V& first, V& second, std::index_sequence<Lane...>) {
  constexpr std::size_t kHalf = sizeof...(Lane) / 2;
  first = __builtin_shufflevector(a, b, static_cast<int>(Lane % kHalf * 4 + Lane / kHalf)...);
  second = __builtin_shufflevector(a, b, static_cast<int>(Lane % kHalf * 4 + Lane / kHalf + 2)...);
}

template <class V, std::size_t... Lane>
ARRIS_ALWAYS_INLINE void join_halves(const V& a, const V& b, V& first, V& second, std::index_sequence<Lane...>) {
  constexpr std::size_t kLanes = sizeof...(Lane), kHalf = kLanes / 2;
  first = __builtin_shufflevector(a, b, static_cast<int>(Lane < kHalf ? Lane : Lane + kHalf)...);
  second = __builtin_shufflevector(a, b, static_cast<int>(Lane < kHalf ? Lane + kHalf : Lane + kLanes)...);
}

}  // namespace detail

/// As many rows as V has lanes.
template <class V>
struct ColumnsOfFour {
  static constexpr std::size_t kLanes = sizeof(V) / sizeof(float);

  /// @param row_at(i)  where row i is, 16 bytes. They are read one at a time, as they were written: a processor cannot
  /// read at once what several writes have left, before that has come to the cache.
  template <class RowAt>
  ARRIS_ALWAYS_INLINE explicit ColumnsOfFour(const RowAt& row_at) {
    const V first = load_rows<sizeof(V)>(row_at, 0), second = load_rows<sizeof(V)>(row_at, kLanes / 4);
    const V third = load_rows<sizeof(V)>(row_at, kLanes / 2), fourth = load_rows<sizeof(V)>(row_at, kLanes / 4 * 3);
    constexpr auto kAll = std::make_index_sequence<kLanes>();
    V ab_low, ab_high, cd_low, cd_high;
    detail::part_pairs(first, second, ab_low, cd_low, kAll);
    detail::part_pairs(third, fourth, ab_high, cd_high, kAll);
    detail::join_halves(ab_low, ab_high, a, b, kAll);
    detail::join_halves(cd_low, cd_high, c, d, kAll);
  }

  V a, b, c, d;

 private:
  template <std::size_t Bytes, class RowAt>
  static ARRIS_ALWAYS_INLINE typename Wide<Bytes>::Float load_rows(const RowAt& row_at, std::size_t first) {
    if constexpr (Bytes == 16) {
      return load<typename Wide<16>::Float>(row_at(first));
    } else {
      return detail::joined(load_rows<Bytes / 2>(row_at, first), load_rows<Bytes / 2>(row_at, first + Bytes / 32),
                            std::make_index_sequence<Bytes / sizeof(float)>());
    }
  }
};

/// Of floats. (A loop: conversions of vectors are taken apart by compilers.)
template <class V>
ARRIS_ALWAYS_INLINE void store_doubles(double* to, const V& v) {
  constexpr std::size_t kLanes = sizeof(V) / sizeof(float);
  alignas(sizeof(V)) float lanes[kLanes];
  store(lanes, v);
  for (std::size_t lane = 0; lane < kLanes; ++lane) to[lane] = static_cast<double>(lanes[lane]);
}

}  // namespace arris::simd
