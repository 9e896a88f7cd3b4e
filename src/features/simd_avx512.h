#pragma once
/// @file Compaction is the one thing that portable vector code cannot say: hand-written for AVX-512, with a scalar form beside it.

#include "features/simd.h"

#if defined(__GNUC__) && defined(__x86_64__) && !defined(ARRIS_NO_SIMD_CLONES)
#define ARRIS_HAS_AVX512 1
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC 12 warns of its own header.
#endif
#include <immintrin.h>
#define ARRIS_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,popcnt")))

namespace arris::simd {

inline bool has_avx512() {
  static const bool has = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return has;
}

}  // namespace arris::simd
#else
#define ARRIS_HAS_AVX512 0
#endif
