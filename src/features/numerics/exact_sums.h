#pragma once
/// @file Sums where nothing rounds: products and partial sums are multiples of one grid, below its 2^53 (2^24 in
/// float). Then neither the order of additions nor the fusing of a product with a sum changes a bit.

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

/// Halves are added to halves. The lanes of float vectors are added as doubles.
template <class V>
ARRIS_ALWAYS_INLINE double exact_lane_sum(const V& v) {
  constexpr int kBytes = static_cast<int>(sizeof(V));
  if constexpr (sizeof(v[0]) == sizeof(float)) {
    typedef float Half __attribute__((vector_size(kBytes / 2)));
    Half halves[2];
    std::memcpy(halves, &v, sizeof(V));
    using Doubles = typename Wide<kBytes>::Double;
    return exact_lane_sum(__builtin_convertvector(halves[0], Doubles) + __builtin_convertvector(halves[1], Doubles));
  } else if constexpr (kBytes > 16) {
    typename Wide<kBytes / 2>::Double halves[2];
    std::memcpy(halves, &v, sizeof(V));
    return exact_lane_sum(halves[0] + halves[1]);
  } else {
    return v[0] + v[1];
  }
}

}  // namespace arris::simd
