#pragma once
/// @file Vectors of a width chosen at run time, for the hot loops.
///
/// A kernel is a struct with a static template `run<Bytes>(args...)` that works with vectors of that many bytes;
/// simd::dispatch calls it at the width that the processor has, in a function compiled for that processor.
///
/// Law: a kernel gives the same bits at every width. Contraction is off, and only + - * / sqrt, comparisons and bit
/// operations are used, all exactly defined by IEEE 754; sums over lanes are either exact or made in an order that the
/// width does not touch.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#if defined(__GNUC__)
#pragma GCC diagnostic ignored \
    "-Wpsabi"  // Vectors never cross a call that is not inlined, so their ABI does not matter.
#endif

#define ARRIS_ALWAYS_INLINE inline __attribute__((always_inline))
/// Before a loop over an array of vectors: only without the loop do they stay in registers.
#define ARRIS_UNROLL _Pragma("GCC unroll 32")

#if defined(__GNUC__) && defined(__x86_64__) && !defined(ARRIS_PLAIN_KERNELS)
#define ARRIS_X86_KERNELS 1
#define ARRIS_TARGET_V3 __attribute__((target("avx2,bmi,bmi2,lzcnt,popcnt,fma")))
#define ARRIS_TARGET_V4 \
  __attribute__((target("avx2,bmi,bmi2,lzcnt,popcnt,fma,avx512f,avx512bw,avx512cd,avx512dq,avx512vl")))
#else
#define ARRIS_X86_KERNELS 0
#endif

namespace arris::simd {

template <int Bytes>
struct Wide {
  typedef float Float __attribute__((vector_size(Bytes)));
  typedef double Double __attribute__((vector_size(Bytes)));
  typedef std::int32_t Int __attribute__((vector_size(Bytes)));
  typedef std::uint32_t Word __attribute__((vector_size(Bytes)));  ///< Wraps where Int must not overflow.
  typedef std::int64_t Long __attribute__((vector_size(Bytes)));
  typedef std::uint64_t Unsigned __attribute__((vector_size(Bytes)));
};

/// The vector of float or double, the integers that its comparisons give, and how many lanes it has.
template <class T, int Bytes>
struct VectorOf;
template <int Bytes>
struct VectorOf<float, Bytes> {
  using Type = typename Wide<Bytes>::Float;
  using Mask = typename Wide<Bytes>::Int;
  static constexpr std::size_t kLanes = Bytes / sizeof(float);
};
template <int Bytes>
struct VectorOf<double, Bytes> {
  using Type = typename Wide<Bytes>::Double;
  using Mask = typename Wide<Bytes>::Long;
  static constexpr std::size_t kLanes = Bytes / sizeof(double);
};

/// The float, or the vector of as many floats, for a double or a vector of doubles; and its integers.
template <class V>
struct Narrow {
  using Float = typename Wide<sizeof(V) / 2>::Float;
  using Int = typename Wide<sizeof(V) / 2>::Int;
};
template <>
struct Narrow<double> {
  using Float = float;
  using Int = std::int32_t;
};

/// Each lane converted, as by static_cast.
template <class To, class V>
ARRIS_ALWAYS_INLINE To convert(const V& v) {
  if constexpr (std::is_arithmetic_v<V>) {
    return static_cast<To>(v);
  } else {
    return __builtin_convertvector(v, To);
  }
}

constexpr int kWidestBytes = 64;
/// Arrays read by kernels are padded to a multiple of this many elements.
constexpr std::size_t kPadding = 16;
constexpr std::size_t padded(std::size_t count) {
  return (count + kPadding - 1) / kPadding * kPadding;
}

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

ARRIS_ALWAYS_INLINE double square_root(double v) {
  return std::sqrt(v);
}
template <class V>
ARRIS_ALWAYS_INLINE V square_root(const V& v) {
  V root;
  for (std::size_t lane = 0; lane < sizeof(V) / sizeof(double); ++lane) root[lane] = std::sqrt(v[lane]);
  return root;
}

/// Bits of doubles, one or many.
ARRIS_ALWAYS_INLINE std::int64_t bits(double v) {
  return std::bit_cast<std::int64_t>(v);
}
template <class V>
ARRIS_ALWAYS_INLINE auto bits(const V& v) {
  return (typename Wide<sizeof(V)>::Long)v;
}
ARRIS_ALWAYS_INLINE double from_bits(std::int64_t v) {
  return std::bit_cast<double>(v);
}
template <class L>
ARRIS_ALWAYS_INLINE auto from_bits(const L& v) {
  return (typename Wide<sizeof(L)>::Double)v;
}
/// |v|.
template <class V>
ARRIS_ALWAYS_INLINE V magnitude(const V& v) {
  return from_bits(bits(v) & std::int64_t{0x7fffffffffffffff});
}
ARRIS_ALWAYS_INLINE std::int64_t shift_right_unsigned(std::int64_t v, int by) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(v) >> by);
}
template <class L>
ARRIS_ALWAYS_INLINE L shift_right_unsigned(const L& v, int by) {
  return (L)((typename Wide<sizeof(L)>::Unsigned)v >> static_cast<std::uint64_t>(by));
}

/// 1.0 in the lanes that `mask` is set in, else 0.0: by its bits, because selections that are combined are taken apart
/// by compilers, lane by lane.
template <class V, class Mask>
ARRIS_ALWAYS_INLINE V ones(const Mask& mask) {
  constexpr std::int64_t kOne = 0x3ff0000000000000;
  return (V)((typename Wide<sizeof(V)>::Long)mask & kOne);
}
/// 1.0 in the lanes where a > b, else 0.0.
template <class V, class W>
ARRIS_ALWAYS_INLINE V where_above(const V& a, const W& b) {
  return ones<V>(a > b);
}
/// 1.0 where a <= b.
template <class V, class W>
ARRIS_ALWAYS_INLINE V where_at_most(const V& a, const W& b) {
  return ones<V>(a <= b);
}

/// What the processor offers: 64 with AVX-512, 32 with AVX2, else 16. The environment's ARRIS_KERNEL_BYTES (16 or 32),
/// for tests, asks for less.
inline int widest_bytes() {
#if ARRIS_X86_KERNELS
  static const int bytes = [] {
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                    __builtin_cpu_supports("popcnt") && __builtin_cpu_supports("fma");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    const int widest = v4 ? 64 : v3 ? 32 : 16;
    const char* asked = std::getenv("ARRIS_KERNEL_BYTES");
    return asked == nullptr ? widest : std::min(widest, std::atoi(asked));
  }();
  return bytes;
#else
  return 16;
#endif
}

#if ARRIS_X86_KERNELS
template <class Kernel, class... Args>
ARRIS_TARGET_V4 void run_v4(Args&... args) {
  Kernel::template run<64>(args...);
}
template <class Kernel, class... Args>
ARRIS_TARGET_V3 void run_v3(Args&... args) {
  Kernel::template run<32>(args...);
}
#endif

/// Calls Kernel::run, which must be always inline, at the given width or the processor's.
template <class Kernel, class... Args>
void dispatch_at(int bytes, Args&&... args) {
#if ARRIS_X86_KERNELS
  if (bytes == 64) return run_v4<Kernel>(args...);
  if (bytes == 32) return run_v3<Kernel>(args...);
#endif
  static_cast<void>(bytes);
  Kernel::template run<16>(args...);
}
template <class Kernel, class... Args>
void dispatch(Args&&... args) {
  dispatch_at<Kernel>(widest_bytes(), args...);
}
/// For kernels that go through `count` doubles, no more than the widest vector has, with divisions and roots one after
/// the other: those of 64 bytes take up to twice as long as those of 32.
template <class Kernel, class... Args>
void dispatch_for(std::size_t count, Args&&... args) {
  dispatch_at<Kernel>(count > 32 / sizeof(double) ? widest_bytes() : std::min(widest_bytes(), 32), args...);
}

}  // namespace arris::simd
