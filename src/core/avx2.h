#pragma once
/// @file Whether a loop's AVX2 version may run. Both versions are the same source, of integers or of the same
/// roundings: the same bits.

#include <cstdlib>

#if defined(__GNUC__) && defined(__x86_64__)
#define ARRIS_AVX2_VERSIONS 1
#else
#define ARRIS_AVX2_VERSIONS 0
#endif

#if ARRIS_AVX2_VERSIONS
namespace arris {

/// The processor has it, and the environment's ARRIS_KERNEL_BYTES, for tests, does not ask for less than 32.
inline bool may_use_avx2() {
  static const bool may = [] {
    const char* asked = std::getenv("ARRIS_KERNEL_BYTES");
    return __builtin_cpu_supports("avx2") && (asked == nullptr || std::atoi(asked) >= 32);
  }();
  return may;
}

}  // namespace arris
#endif
