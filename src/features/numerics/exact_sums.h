#pragma once
/// @file Sums where nothing rounds: products and partial sums are multiples of one grid, below its 2^53 (2^24 in
/// float). Then neither the order of additions nor the fusing of a product with a sum changes a bit.

#include <array>
#include <type_traits>
#include <utility>

#include "features/numerics/simd.h"

namespace arris::simd {

/// sum + a * b in one operation where the processor has it: all that vectors of more than 16 bytes are made for.
template <class V>
ARRIS_ALWAYS_INLINE V exact_multiply_add(const V& a, const V& b, const V& sum) {
  if constexpr (sizeof(V) > 16) {
    V result;
    for (std::size_t lane = 0; lane < sizeof(V) / sizeof(a[0]); ++lane) {
      result[lane] = std::fma(a[lane], b[lane], sum[lane]);
    }
    return result;
  } else {
    return sum + a * b;
  }
}

/// Of a vector of doubles: halves are added to halves.
template <class V>
ARRIS_ALWAYS_INLINE double exact_lane_sum(const V& v) {
  static_assert(sizeof(v[0]) == sizeof(double));
  constexpr int kBytes = static_cast<int>(sizeof(V));
  if constexpr (kBytes > 16) {
    typename Wide<kBytes / 2>::Double halves[2];
    std::memcpy(halves, &v, sizeof(V));
    return exact_lane_sum(halves[0] + halves[1]);
  } else {
    return v[0] + v[1];
  }
}

namespace detail {

/// The sums of the pairs of lanes of a and b, in turn.
template <class V, std::size_t... Lane>
ARRIS_ALWAYS_INLINE V add_lanes(const V& a, const V& b, std::index_sequence<Lane...>) {
  constexpr std::size_t kLanes = sizeof...(Lane);
  if constexpr (sizeof(a[0]) == 8) {
    return __builtin_shufflevector(a, b, (Lane % 2 == 0 ? Lane : kLanes + Lane - 1)...) +
           __builtin_shufflevector(a, b, (Lane % 2 == 0 ? Lane + 1 : kLanes + Lane)...);
  } else {  // Of four lanes, those that are two apart: a, b, a, b.
    return __builtin_shufflevector(a, b, (Lane / 4 * 4 + Lane % 4 / 2 + Lane % 2 * kLanes)...) +
           __builtin_shufflevector(a, b, (Lane / 4 * 4 + Lane % 4 / 2 + Lane % 2 * kLanes + 2)...);
  }
}

/// Of 32 bits: the sums of halves of 16 bytes, first those of a.
template <class V, std::size_t... Lane>
ARRIS_ALWAYS_INLINE V add_halves(const V& a, const V& b, std::index_sequence<Lane...>) {
  constexpr std::size_t kLanes = sizeof...(Lane);
  return __builtin_shufflevector(a, b, (Lane / 4 * 4 + Lane % 2 + Lane % 4 / 2 * kLanes)...) +
         __builtin_shufflevector(a, b, (Lane / 4 * 4 + Lane % 2 + Lane % 4 / 2 * kLanes + 2)...);
}

/// The same of pairs of 16 bytes; first those of a.
template <class V, std::size_t... Lane>
ARRIS_ALWAYS_INLINE V add_pairs(const V& a, const V& b, std::index_sequence<Lane...>) {
  constexpr std::size_t kPart = 16 / sizeof(a[0]);
  return __builtin_shufflevector(a, b, (Lane / kPart * 2 * kPart + Lane % kPart)...) +
         __builtin_shufflevector(a, b, (Lane / kPart * 2 * kPart + Lane % kPart + kPart)...);
}

}  // namespace detail

/// The sums of the lanes of several vectors of doubles or 32-bit integers: two vectors become one until a lane is a
/// total, in a third of the operations.
template <class V, std::size_t Count>
ARRIS_ALWAYS_INLINE auto exact_lane_sums(const V (&sums)[Count]) {
  constexpr std::size_t kLanes = sizeof(V) / sizeof(sums[0][0]);
  constexpr auto kEach = std::make_index_sequence<kLanes>();
  V folded[(Count + 1) / 2];
  std::size_t left = (Count + 1) / 2;
  for (std::size_t i = 0; i < left; ++i) {
    folded[i] = detail::add_lanes(sums[2 * i], sums[std::min(2 * i + 1, Count - 1)], kEach);
  }
  const auto fold = [&](const auto& add) __attribute__((always_inline)) {
    const std::size_t last = left - 1;
    left = (left + 1) / 2;
    for (std::size_t i = 0; i < left; ++i) folded[i] = add(folded[2 * i], folded[std::min(2 * i + 1, last)]);
  };
  if constexpr (sizeof(sums[0][0]) == 4) {
    fold([&](const V& a, const V& b) __attribute__((always_inline)) { return detail::add_halves(a, b, kEach); });
  }
  for (std::size_t pairs = sizeof(V) / 16; pairs > 1; pairs /= 2) {
    fold([&](const V& a, const V& b) __attribute__((always_inline)) { return detail::add_pairs(a, b, kEach); });
  }
  std::array<std::remove_cvref_t<decltype(sums[0][0])>, Count> totals;
  std::memcpy(totals.data(), folded, sizeof(totals));
  return totals;
}

/// A vector of doubles with the same sum. Of floats and 32-bit integers, the halves are added as doubles.
template <class V>
ARRIS_ALWAYS_INLINE auto exact_doubles(const V& v) {
  if constexpr (sizeof(v[0]) == sizeof(double)) {
    return v;
  } else {
    typedef std::remove_cvref_t<decltype(v[0])> Half __attribute__((vector_size(sizeof(V) / 2)));
    Half halves[2];
    std::memcpy(halves, &v, sizeof(V));
    using Doubles = typename Wide<static_cast<int>(sizeof(V))>::Double;
    return __builtin_convertvector(halves[0], Doubles) + __builtin_convertvector(halves[1], Doubles);
  }
}

}  // namespace arris::simd
