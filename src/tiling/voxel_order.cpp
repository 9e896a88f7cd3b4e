#include "tiling/voxel_order.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "tiling/morton.h"
#include "tiling/z_order_key.h"

namespace arris::tiling {
namespace {

constexpr int kMostDigitBits = 11;

constexpr int kMostPasses = 6;

using Counts = std::array<std::uint32_t, std::size_t{1} << kMostDigitBits>;

struct Keyed {
  PageArray<std::uint64_t> keys;
  PageArray<std::uint32_t> indices;
  explicit Keyed(std::size_t size) : keys(size), indices(size) {}
};

/// @param next  where the first element of each digit goes.
void radix_pass(const Keyed& from, Keyed& to, std::size_t size, int shift, Counts& next) {
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint64_t key = from.keys[i];
    const std::uint32_t place = next[key >> shift & (next.size() - 1)]++;
    to.keys[place] = key;
    to.indices[place] = from.indices[i];
  }
}

PageArray<std::uint32_t> radix_order(std::span<const VoxelSums> sums, const ZOrderKey& key_of) {
  const std::size_t size = sums.size();
  const int passes = (key_of.bits() + kMostDigitBits - 1) / kMostDigitBits;
  auto counts = std::make_unique<std::array<Counts, kMostPasses>>();
  Keyed sorted(size), spare(size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint64_t key = key_of(sums[i].key);
    sorted.keys[i] = key;
    sorted.indices[i] = static_cast<std::uint32_t>(i);
    for (int pass = 0; pass < passes; ++pass) ++(*counts)[pass][key >> pass * kMostDigitBits & (Counts{}.size() - 1)];
  }
  for (int pass = 0; pass < passes; ++pass) {
    Counts& next = (*counts)[pass];
    if (std::ranges::find(next, size) != next.end()) continue;  // All have the same digit.
    std::uint32_t begin = 0;
    for (std::uint32_t& count : next) begin += std::exchange(count, begin);
    radix_pass(sorted, spare, size, pass * kMostDigitBits, next);
    std::swap(sorted, spare);
  }
  return std::move(sorted.indices);
}

PageArray<std::uint32_t> compared_order(std::span<const VoxelSums> sums) {
  PageArray<std::uint32_t> order(sums.size());
  const std::span<std::uint32_t> indices = order.first(sums.size());
  std::iota(indices.begin(), indices.end(), 0U);
  std::ranges::sort(indices, [&](std::uint32_t a, std::uint32_t b) { return z_order_less(sums[a].key, sums[b].key); });
  return order;
}

}  // namespace

PageArray<std::uint32_t> z_order_of(std::span<const VoxelSums> sums) {
  if (sums.empty()) return {};
  LatticePoint least = sums.front().key, most = least;
  for (const VoxelSums& s : sums) {
    least = {std::min(least.x, s.key.x), std::min(least.y, s.key.y), std::min(least.z, s.key.z)};
    most = {std::max(most.x, s.key.x), std::max(most.y, s.key.y), std::max(most.z, s.key.z)};
  }
  const std::optional<ZOrderKey> key_of = ZOrderKey::for_range(least, most);
  return key_of ? radix_order(sums, *key_of) : compared_order(sums);
}

}  // namespace arris::tiling
