#include "features/arris/azimuth_spread.h"

#include <algorithm>
#include <limits>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

/// angle_of() of many directions: the same operations, branches as selections.
struct Angles {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const double* u, const double* v, std::size_t n, double* angles) {
    using V = typename simd::Wide<Bytes>::Double;
    constexpr double kTangent[] = {0.19891236737965800691, 0.66817863791929891999};      // tan(pi/16), tan(3 pi/16)
    constexpr double kCentre[] = {0.41421356237309504880, 1.0};                          // tan(pi/8), tan(pi/4)
    constexpr double kCentreAngle[] = {0.39269908169872415481, 0.78539816339744830962};  // pi/8, pi/4
    for (std::size_t i = 0; i < n; i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(u + i), y = simd::load<V>(v + i);
      const V ax = simd::magnitude(x);
      const V ay = simd::magnitude(y);
      V t = (ax < ay ? ax : ay) / (ax < ay ? ay : ax);
      const V zero{};
      const V centre = t > kTangent[1] ? zero + kCentre[1] : (t > kTangent[0] ? zero + kCentre[0] : zero);
      const V base = t > kTangent[1] ? zero + kCentreAngle[1] : (t > kTangent[0] ? zero + kCentreAngle[0] : zero);
      t = (t - centre) / (1.0 + t * centre);
      const V z = t * t;
      V sum = zero;
      for (int k = 23; k >= 3; k -= 2) sum = 1.0 / k - z * sum;
      V angle = base + (t - t * z * sum);
      angle = ay > ax ? kPi / 2 - angle : angle;
      angle = x < 0.0 ? kPi - angle : angle;
      simd::store(angles + i, y < 0.0 ? -angle : angle);
    }
  }
};

}  // namespace

double widest_azimuth_gap(const double* u, const double* v, std::size_t n, AzimuthScratch& s) {
  s.azimuths.resize(simd::padded(n));
  simd::dispatch<Angles>(u, v, n, s.azimuths.data());
  const std::size_t bins = 2 * n;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  s.first.assign(bins, kNone);
  s.last.assign(bins, -kNone);
  const double per_radian = static_cast<double>(bins) / (2.0 * kPi);
  for (std::size_t i = 0; i < n; ++i) {
    const double azimuth = s.azimuths[i];
    const std::size_t bin = std::min(static_cast<std::size_t>((azimuth + kPi) * per_radian), bins - 1);
    s.first[bin] = std::min(s.first[bin], azimuth);
    s.last[bin] = std::max(s.last[bin], azimuth);
  }
  double front = kNone;
  double before = -kNone;  // The last azimuth of the bins so far.
  double widest = 0.0;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    if (s.first[bin] == kNone) continue;
    if (front == kNone) {
      front = s.first[bin];
    } else {
      widest = std::max(widest, s.first[bin] - before);
    }
    before = s.last[bin];
  }
  return std::max(widest, front + 2.0 * kPi - before);
}

}  // namespace arris
