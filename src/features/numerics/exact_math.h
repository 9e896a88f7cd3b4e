#pragma once
/// @file Logarithm and arc functions from + - * / sqrt only, so that results do not depend on the C library or the
/// processor.
///
/// `V` is double or a vector of doubles; all give the same bits lane by lane.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "features/numerics/simd.h"

namespace arris {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegreesPerRadian = 180.0 / kPi;

/// Natural logarithm of a positive normal number; relative error about 1e-15 away from 1, absolute error 1e-16 near 1.
template <class V>
ARRIS_ALWAYS_INLINE V log_of_positive(const V& x) {
  constexpr std::int64_t kOne = 0x3ff0000000000000;
  constexpr std::int64_t kSqrtHalf = 0x3fe6a09e667f3bcd;
  constexpr std::int64_t kTwoTo52 = 0x4330000000000000;
  const auto raw = simd::bits(x);
  const auto biased =
      simd::shift_right_unsigned(raw + (kOne - kSqrtHalf), 52);  // Exponent + 1023 for m in [sqrt(1/2), sqrt(2)).
  const V exponent = simd::from_bits(biased | kTwoTo52) - (4503599627370496.0 + 1023.0);
  const V m = simd::from_bits(raw - ((biased - 1023) << 52));
  const V s = (m - 1.0) / (m + 1.0);
  const V z = s * s;  // log m = 2 atanh(s), |s| < 0.1716: the term after the last one kept is below 1e-17.
  V sum = z * (1.0 / 21.0) + 1.0 / 19.0;
  sum = sum * z + 1.0 / 17.0;
  sum = sum * z + 1.0 / 15.0;
  sum = sum * z + 1.0 / 13.0;
  sum = sum * z + 1.0 / 11.0;
  sum = sum * z + 1.0 / 9.0;
  sum = sum * z + 1.0 / 7.0;
  sum = sum * z + 1.0 / 5.0;
  sum = sum * z + 1.0 / 3.0;
  return exponent * 0.69314718055994530942 + 2.0 * (s + s * z * sum);
}

/// The same in float arithmetic: error below 2e-7 of max(1, |log x|). V, double or a vector of doubles, says how many.
/// @param x  positive, not subnormal.
template <class V>
ARRIS_ALWAYS_INLINE typename simd::Narrow<V>::Float short_log_of_positive(const typename simd::Narrow<V>::Float& x) {
  using Float = typename simd::Narrow<V>::Float;
  using Int = typename simd::Narrow<V>::Int;
  constexpr std::int32_t kOne = 0x3f800000;
  constexpr std::int32_t kSqrtHalf = 0x3f3504f3;
  const Int raw = std::bit_cast<Int>(x);
  const Int exponent = ((raw + (kOne - kSqrtHalf)) >> 23) - 127;
  const Float m = std::bit_cast<Float>(raw - exponent * (1 << 23));  // In [sqrt(1/2), sqrt(2)).
  const Float s = (m - 1.0F) / (m + 1.0F);
  const Float z = s * s;
  Float sum = z * (1.0F / 9.0F) + 1.0F / 7.0F;
  sum = sum * z + 1.0F / 5.0F;
  sum = sum * z + 1.0F / 3.0F;
  return simd::convert<Float>(exponent) * 0.69314718F + 2.0F * (s + s * z * sum);
}

/// exp(-x) for x >= 0; relative error below 1e-14, 0 beyond x = 700.
template <class V>
ARRIS_ALWAYS_INLINE V exponential_decay(const V& x) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to whole numbers.
  const V zero = x - x;
  const V cut = x < 700.0 ? x : zero + 700.0;
  const V shifted = cut * 1.44269504088896340736 + kRound;
  const V whole = shifted - kRound;
  // ln 2 in two parts, the first with few enough bits that its multiples are exact.
  const V r = (cut - whole * 0.693147180369123816490) - whole * 1.90821492927058770002e-10;  // In [-0.35, 0.35].
  V sum = zero + 1.0 / 479001600.0;  // Terms of exp(-r) up to r^12.
  sum = 1.0 / 39916800.0 - sum * r;
  sum = 1.0 / 3628800.0 - sum * r;
  sum = 1.0 / 362880.0 - sum * r;
  sum = 1.0 / 40320.0 - sum * r;
  sum = 1.0 / 5040.0 - sum * r;
  sum = 1.0 / 720.0 - sum * r;
  sum = 1.0 / 120.0 - sum * r;
  sum = 1.0 / 24.0 - sum * r;
  sum = 1.0 / 6.0 - sum * r;
  sum = 0.5 - sum * r;
  sum = 1.0 - sum * r;
  sum = 1.0 - sum * r;
  // 2^-whole, from the whole number in the low bits of `shifted`; at least 2^-1010, a normal number.
  const auto raw = simd::bits(shifted) - simd::bits(zero + kRound);
  const V power = simd::from_bits((1023 - raw) << 52);
  return x < 700.0 ? sum * power : zero;
}

/// Angle of (x, y) in (-pi, pi]; 0 for (0, 0). Error below 4e-16.
inline double angle_of(double y, double x) {
  const double ax = std::fabs(x);
  const double ay = std::fabs(y);
  const double large = std::max(ax, ay);
  if (large == 0.0) return 0.0;
  // Reduce the ratio t in [0, 1] by the addition theorem to |t| <= tan(pi/16), where the series converges fast.
  constexpr double kTangent[] = {0.19891236737965800691, 0.66817863791929891999};      // tan(pi/16), tan(3 pi/16)
  constexpr double kCentre[] = {0.41421356237309504880, 1.0};                          // tan(pi/8), tan(pi/4)
  constexpr double kCentreAngle[] = {0.39269908169872415481, 0.78539816339744830962};  // pi/8, pi/4
  double t = std::min(ax, ay) / large;
  double base = 0.0;
  for (int i = 1; i >= 0; --i) {
    if (t > kTangent[i]) {
      t = (t - kCentre[i]) / (1.0 + t * kCentre[i]);
      base = kCentreAngle[i];
      break;
    }
  }
  const double z = t * t;  // Below 0.0396: eleven terms reach 1e-17.
  double sum = 0.0;
  for (int n = 23; n >= 3; n -= 2) sum = 1.0 / n - z * sum;
  double angle = base + (t - t * z * sum);
  if (ay > ax) angle = kPi / 2 - angle;
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

/// cos x for x in [0, pi / 2] by its series; error below 1e-15.
inline double cosine(double x) {
  double sum = 0.0;
  for (int n = 24; n >= 2; n -= 2) sum = x * x / (n * (n - 1)) * (1.0 - sum);
  return 1.0 - sum;
}

/// Arc cosine of x, which is clamped to [-1, 1].
inline double arc_cosine(double x) {
  x = std::clamp(x, -1.0, 1.0);
  return angle_of(std::sqrt((1.0 - x) * (1.0 + x)), x);
}

}  // namespace arris
