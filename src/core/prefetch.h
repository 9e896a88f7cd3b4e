#pragma once
/// @file Fetches memory that is needed soon.

namespace arris {

/// The address need not be valid. Functions that only prefetch GCC (12) takes for functions without effect and leaves
/// their calls out, unless they are inlined early: the empty assembly is an effect.
inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  asm volatile("");
}
/// The same for memory that will be written to.
inline void prefetch_to_write(const void* address) {
  __builtin_prefetch(address, 1);
  asm volatile("");
}

}  // namespace arris
