#pragma once
/// @file Compaction is the one thing that portable vector code cannot say: intrinsics for AVX-512 and AVX2.

#include "features/numerics/simd.h"

#if ARRIS_X86_KERNELS
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC 12 warns of its own header.
#endif
#include <immintrin.h>

namespace arris::simd {

/// For each of the 256 masks of eight lanes, the lanes that are set, in order.
struct CompactTable {
  alignas(32) std::int32_t lanes[256][8];
  constexpr CompactTable() : lanes{} {
    for (int mask = 0; mask < 256; ++mask) {
      int n = 0;
      for (int lane = 0; lane < 8; ++lane) {
        if (mask >> lane & 1) lanes[mask][n++] = lane;
      }
    }
  }
};
inline constexpr CompactTable kCompactTable;

}  // namespace arris::simd
#endif
