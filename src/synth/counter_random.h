#pragma once
/// @file Random numbers that depend on a seed and a counter only, so that any point can be made without the ones before
/// it.

#include <cstdint>

#include "synth/deterministic_math.h"

namespace arris::synth {

constexpr std::uint64_t kGoldenGamma = 0x9e3779b97f4a7c15ULL;

/// A bijection of 64-bit words that looks random (Steele, Lea, Flood 2014, "SplitMix"; Stafford's variant 13).
inline std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Key of stream `index` below `key`.
inline std::uint64_t derive_key(std::uint64_t key, std::uint64_t index) {
  return mix64(mix64(key + kGoldenGamma) ^ (index * kGoldenGamma + 0x632be59bd9b4e019ULL));
}

/// The draws of one point: SplitMix64 that starts at a key.
class PointRandom {
 public:
  explicit PointRandom(std::uint64_t key) : state_(key) {}

  std::uint64_t bits() {
    state_ += kGoldenGamma;
    return mix64(state_);
  }
  /// In (0, 1), never 0 or 1.
  double uniform() { return (static_cast<double>(bits() >> 12) + 0.5) * 0x1.0p-52; }
  /// Standard normal.
  double normal() { return normal_quantile(uniform()); }

 private:
  std::uint64_t state_;
};

}  // namespace arris::synth
