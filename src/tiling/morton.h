#pragma once
/// @file Z-order (Morton order) of lattice positions: neighbours in the sequence are neighbours in space.

#include <cstdint>

#include "core/lattice.h"

namespace arris::tiling {

/// Compares interleaved bits, x first among bits of one rank, without building the 96-bit key (Chan 2002).
/// The sign bit is flipped, so that negative coordinates come first.
inline bool z_order_less(const LatticePoint& a, const LatticePoint& b) {
  const auto flip = [](std::int32_t v) { return static_cast<std::uint32_t>(v) ^ 0x80000000U; };
  const auto lower_rank = [](std::uint32_t m, std::uint32_t n) { return m < n && m < (m ^ n); };
  std::uint32_t differing = flip(a.x) ^ flip(b.x);
  bool less = flip(a.x) < flip(b.x);
  if (const std::uint32_t y = flip(a.y) ^ flip(b.y); lower_rank(differing, y)) {
    differing = y;
    less = flip(a.y) < flip(b.y);
  }
  if (const std::uint32_t z = flip(a.z) ^ flip(b.z); lower_rank(differing, z)) less = flip(a.z) < flip(b.z);
  return less;
}

/// Spreads the low 21 bits of v so that two free bits follow each.
inline std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffffU;
  v = (v | v << 32) & 0x1f00000000ffffU;
  v = (v | v << 16) & 0x1f0000ff0000ffU;
  v = (v | v << 8) & 0x100f00f00f00f00fU;
  v = (v | v << 4) & 0x10c30c30c30c30c3U;
  v = (v | v << 2) & 0x1249249249249249U;
  return v;
}

/// Z-order key of three coordinates of 21 bits.
inline std::uint64_t z_key(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return spread_bits(x) << 2 | spread_bits(y) << 1 | spread_bits(z);
}

}  // namespace arris::tiling
