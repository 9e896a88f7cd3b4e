#pragma once
/// @file Fixed-width vectors for the hot loops, lowered by the compiler to whatever the processor has.
///
/// Law: a kernel gives the same bits on every instruction set. The lanes are part of the algorithm (a Double8 is eight partial sums
/// everywhere), contraction is off, and only + - * / sqrt, comparisons and bit operations are used, all exactly defined by IEEE 754.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpsabi"  // Vectors never cross a call that is not inlined, so their ABI does not matter.
#endif

// One clone per instruction set, chosen when the program is loaded. Not with sanitizers: the resolvers run before their runtime is up.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(ARRIS_NO_SIMD_CLONES)
#define ARRIS_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define ARRIS_HAS_SIMD_CLONES 1
#else
#define ARRIS_SIMD_CLONES
#define ARRIS_HAS_SIMD_CLONES 0
#endif
#define ARRIS_ALWAYS_INLINE inline __attribute__((always_inline))

namespace arris::simd {

typedef float Float16 __attribute__((vector_size(64)));
typedef std::int32_t Int16 __attribute__((vector_size(64)));
typedef double Double8 __attribute__((vector_size(64)));
typedef std::int64_t Long8 __attribute__((vector_size(64)));

/// The vector of a scalar type, and how many lanes it has.
template <class T>
struct VectorOf;
template <>
struct VectorOf<float> {
  using Type = Float16;
  using Mask = Int16;
  static constexpr std::size_t kLanes = 16;
};
template <>
struct VectorOf<double> {
  using Type = Double8;
  using Mask = Long8;
  static constexpr std::size_t kLanes = 8;
};

/// Arrays read by kernels are padded to a multiple of this.
constexpr std::size_t kPadding = 16;
constexpr std::size_t padded(std::size_t count) { return (count + kPadding - 1) / kPadding * kPadding; }

template <class V, class T>
ARRIS_ALWAYS_INLINE V load(const T* from) {
  V v;
  std::memcpy(&v, from, sizeof(V));
  return v;
}

template <class V, class T>
ARRIS_ALWAYS_INLINE void store(T* to, const V& v) {
  std::memcpy(to, &v, sizeof(V));
}

ARRIS_ALWAYS_INLINE double square_root(double v) { return std::sqrt(v); }
ARRIS_ALWAYS_INLINE Double8 square_root(const Double8& v) {
  Double8 root;
  for (int lane = 0; lane < 8; ++lane) root[lane] = std::sqrt(v[lane]);
  return root;
}

ARRIS_ALWAYS_INLINE std::int64_t bits(double v) { return std::bit_cast<std::int64_t>(v); }
ARRIS_ALWAYS_INLINE Long8 bits(const Double8& v) { return (Long8)v; }
ARRIS_ALWAYS_INLINE double from_bits(std::int64_t v) { return std::bit_cast<double>(v); }
ARRIS_ALWAYS_INLINE Double8 from_bits(const Long8& v) { return (Double8)v; }

ARRIS_ALWAYS_INLINE std::int64_t shift_right_unsigned(std::int64_t v, int by) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(v) >> by);
}
ARRIS_ALWAYS_INLINE Long8 shift_right_unsigned(const Long8& v, int by) {
  typedef std::uint64_t Unsigned8 __attribute__((vector_size(64)));
  return (Long8)((Unsigned8)v >> static_cast<std::uint64_t>(by));
}

}  // namespace arris::simd
