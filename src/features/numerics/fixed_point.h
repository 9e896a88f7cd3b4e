#pragma once
/// @file Rounding to a power of two, which makes sums of doubles exact and so independent of their order.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace arris {

/// Rounds values in [0, largest] to multiples of a power of two, chosen so that sums of up to `terms` rounded values
/// are exact. The multiple is about 2^-bits of `largest`, coarser only if that many terms need the room.
class FixedPoint {
 public:
  FixedPoint(double largest, std::size_t terms, int bits) {
    const int room = 51 - static_cast<int>(std::bit_width(terms));
    magic_ = std::ldexp(1.5, 52 + std::ilogb(largest) + 1 - std::min(bits, room));
  }
  double rounded(double value) const { return (value + magic_) - magic_; }
  /// For kernels: the constant whose addition and subtraction rounds.
  double magic() const { return magic_; }

 private:
  double magic_;
};

}  // namespace arris
