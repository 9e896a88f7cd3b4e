#pragma once
/// @file 64-bit sort keys in Z-order for lattice positions that do not lie too far apart.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "core/lattice.h"
#include "tiling/morton.h"

namespace arris::tiling {

/// Law: key(a) < key(b) exactly if z_order_less(a, b), for positions in the box that it was made for.
///
/// Positions of one axis that span at most two neighbouring ranges of 2^t need only t low bits and one more, the
/// topmost in which the two ranges differ: the bits between are the same for all, or follow from that one.
class ZOrderKey {
 public:
  /// For positions in [least, most] per axis; none if an axis spans more than two ranges of 2^20.
  static std::optional<ZOrderKey> for_range(const LatticePoint& least, const LatticePoint& most) {
    ZOrderKey key;
    for (int axis = 0; axis < 3; ++axis) {
      while ((flip(most[axis]) >> key.low_bits_) - (flip(least[axis]) >> key.low_bits_) > 1) ++key.low_bits_;
    }
    if (key.low_bits_ > 20) return std::nullopt;
    // Upper bits go above all low ones: the more significant the higher, x first among equals.
    std::array<int, 3> top{}, order{0, 1, 2};
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint32_t differing = (flip(least[axis]) ^ flip(most[axis])) >> key.low_bits_;
      if (differing != 0) top[axis] = std::bit_width(differing) - 1 + key.low_bits_;
      key.has_top_[axis] = differing != 0;
    }
    std::ranges::stable_sort(order, [&](int a, int b) { return top[a] > top[b]; });
    for (int place = 0; place < 3; ++place) {
      key.from_[order[place]] = top[order[place]];
      key.to_[order[place]] = 3 * key.low_bits_ + 2 - place;
    }
    return key;
  }

  std::uint64_t operator()(const LatticePoint& p) const {
    const std::uint32_t mask = (1U << low_bits_) - 1;
    return z_key(flip(p.x) & mask, flip(p.y) & mask, flip(p.z) & mask) | top_bit(0, p.x) | top_bit(1, p.y) |
           top_bit(2, p.z);
  }
  /// Keys are below 2^bits().
  int bits() const { return 3 * low_bits_ + 3; }

 private:
  static std::uint32_t flip(std::int32_t v) { return static_cast<std::uint32_t>(v) ^ 0x80000000U; }
  std::uint64_t top_bit(int axis, std::int32_t v) const {
    return std::uint64_t{flip(v) >> from_[axis] & has_top_[axis]} << to_[axis];
  }

  int low_bits_ = 0;
  std::array<std::uint32_t, 3> has_top_{};
  std::array<int, 3> from_{}, to_{};
};

}  // namespace arris::tiling
