#include "tiling/voxel_order.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "tiling/morton.h"
#include "tiling/z_order_key.h"

namespace arris::tiling {
namespace {

constexpr int kMostDigitBits = 11;

struct Keyed {
  std::vector<std::uint64_t> keys;
  std::vector<std::uint32_t> indices;
  explicit Keyed(std::size_t size) : keys(size), indices(size) {}
};

void radix_pass(const Keyed& from, Keyed& to, int shift, int digit_bits) {
  const std::uint64_t mask = (std::uint64_t{1} << digit_bits) - 1;
  std::array<std::uint32_t, std::size_t{1} << kMostDigitBits> next{};
  for (const std::uint64_t key : from.keys) ++next[key >> shift & mask];
  std::uint32_t begin = 0;
  for (std::uint32_t& count : next) begin += std::exchange(count, begin);
  for (std::size_t i = 0; i < from.keys.size(); ++i) {
    const std::uint32_t place = next[from.keys[i] >> shift & mask]++;
    to.keys[place] = from.keys[i];
    to.indices[place] = from.indices[i];
  }
}

}  // namespace

std::vector<std::uint32_t> z_order_of(std::span<const VoxelSums> sums) {
  if (sums.empty()) return {};
  LatticePoint least = sums.front().key, most = least;
  for (const VoxelSums& s : sums) {
    least = {std::min(least.x, s.key.x), std::min(least.y, s.key.y), std::min(least.z, s.key.z)};
    most = {std::max(most.x, s.key.x), std::max(most.y, s.key.y), std::max(most.z, s.key.z)};
  }
  const std::optional<ZOrderKey> key_of = ZOrderKey::for_range(least, most);
  if (!key_of) {
    std::vector<std::uint32_t> order(sums.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return z_order_less(sums[a].key, sums[b].key); });
    return order;
  }
  Keyed sorted(sums.size()), spare(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sorted.keys[i] = (*key_of)(sums[i].key);
    sorted.indices[i] = static_cast<std::uint32_t>(i);
  }
  const int passes = (key_of->bits() + kMostDigitBits - 1) / kMostDigitBits;
  const int digit_bits = (key_of->bits() + passes - 1) / passes;
  for (int pass = 0; pass < passes; ++pass) {
    radix_pass(sorted, spare, pass * digit_bits, digit_bits);
    std::swap(sorted, spare);
  }
  return std::move(sorted.indices);
}

}  // namespace arris::tiling
