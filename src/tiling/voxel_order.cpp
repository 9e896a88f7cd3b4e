#include "tiling/voxel_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "tiling/morton.h"
#include "tiling/z_order_key.h"

namespace arris::tiling {
namespace {

constexpr int kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr int kMostPasses = 6;
using Counts = std::array<std::uint32_t, kDigits>;
/// Elements that a thread is worth waking for.
constexpr std::size_t kLeastPart = 32 * 1024;
/// So many of each thread that none waits long for the slowest.
constexpr std::size_t kPartsPerThread = 4;

/// A key and an index in one word.
struct Packed {
  PageArray<std::uint64_t> words;
  int index_bits;

  Packed(std::size_t size, int bits) : words(size), index_bits(bits) {}
  std::uint64_t key(std::size_t i) const { return words[i] >> index_bits; }
  std::uint32_t index(std::size_t i) const {
    return static_cast<std::uint32_t>(words[i] & ((std::uint64_t{1} << index_bits) - 1));
  }
  void set(std::size_t i, std::uint64_t key, std::uint32_t index) { words[i] = key << index_bits | index; }
};

/// A key and an index that do not fit one word.
struct Apart {
  PageArray<std::uint64_t> keys;
  PageArray<std::uint32_t> indices;

  Apart(std::size_t size, int) : keys(size), indices(size) {}
  std::uint64_t key(std::size_t i) const { return keys[i]; }
  std::uint32_t index(std::size_t i) const { return indices[i]; }
  void set(std::size_t i, std::uint64_t key, std::uint32_t index) {
    keys[i] = key;
    indices[i] = index;
  }
};

std::size_t digit(std::uint64_t key, int pass) {
  return key >> pass * kDigitBits & (kDigits - 1);
}

/// One for a single thread.
std::size_t parts_of(std::size_t size) {
  const auto threads = static_cast<std::size_t>(loop_threads());
  return threads <= 1 ? 1 : std::clamp<std::size_t>(size / kLeastPart, 1, kPartsPerThread * threads);
}

/// From how often each digit comes in each part to where the first of them goes. False if all have the same digit.
bool to_places(std::span<Counts> counts, std::size_t size) {
  std::uint32_t begin = 0;
  for (std::size_t value = 0; value < kDigits; ++value) {
    const std::uint32_t before = begin;
    for (Counts& part : counts) begin += std::exchange(part[value], begin);
    if (begin - before == size) return false;
  }
  return true;
}

/// Lowest digit first. Every thread counts and moves a part of the elements; stable, so the order does not depend on
/// how many there are.
template <class Elements>
PageArray<std::uint32_t> radix_order(std::span<const VoxelSums> sums, const ZOrderKey& key_of, int index_bits) {
  const std::size_t size = sums.size();
  const int passes = (key_of.bits() + kDigitBits - 1) / kDigitBits;
  const std::size_t parts = parts_of(size);
  const std::size_t grain = (size + parts - 1) / parts;
  // Elements change their part from pass to pass: several have to be counted again.
  std::array<std::vector<Counts>, kMostPasses> counts;
  for (int pass = 0; pass < passes; ++pass) counts[pass].resize(pass == 0 || parts == 1 ? parts : 0);
  Elements sorted(size, index_bits), spare(size, index_bits);
  parallel_for_chunks(size, grain, [&](std::size_t begin, std::size_t end) {
    const std::size_t part = begin / grain;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint64_t key = key_of(sums[i].key);
      sorted.set(i, key, static_cast<std::uint32_t>(i));
      ++counts[0][part][digit(key, 0)];
      if (parts == 1) {
        for (int pass = 1; pass < passes; ++pass) ++counts[pass][0][digit(key, pass)];
      }
    }
  });
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<Counts>& next = counts[pass];
    if (next.empty()) {
      next.resize(parts);
      parallel_for_chunks(size, grain, [&](std::size_t begin, std::size_t end) {
        Counts& own = next[begin / grain];
        for (std::size_t i = begin; i < end; ++i) ++own[digit(sorted.key(i), pass)];
      });
    }
    if (!to_places(next, size)) continue;
    parallel_for_chunks(size, grain, [&](std::size_t begin, std::size_t end) {
      Counts& own = next[begin / grain];
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint64_t key = sorted.key(i);
        spare.set(own[digit(key, pass)]++, key, sorted.index(i));
      }
    });
    std::swap(sorted, spare);
  }
  { const Elements gone = std::move(spare); }
  PageArray<std::uint32_t> order(size);
  parallel_for_chunks(size, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) order[i] = sorted.index(i);
  });
  return order;
}

/// Of keys, both included.
struct Range {
  LatticePoint least, most;
  void include(const LatticePoint& low, const LatticePoint& high) {
    least = {std::min(least.x, low.x), std::min(least.y, low.y), std::min(least.z, low.z)};
    most = {std::max(most.x, high.x), std::max(most.y, high.y), std::max(most.z, high.z)};
  }
};

/// @param sums  at least one.
Range range_of(std::span<const VoxelSums> sums) {
  const std::size_t parts = parts_of(sums.size());
  const std::size_t grain = (sums.size() + parts - 1) / parts;
  const Range first{sums.front().key, sums.front().key};
  std::vector<Range> ranges(parts, first);
  parallel_for_chunks(sums.size(), grain, [&](std::size_t begin, std::size_t end) {
    Range range = first;
    for (const VoxelSums& s : sums.subspan(begin, end - begin)) range.include(s.key, s.key);
    ranges[begin / grain] = range;
  });
  Range all = first;
  for (const Range& range : ranges) all.include(range.least, range.most);
  return all;
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
  const Range range = range_of(sums);
  const std::optional<ZOrderKey> key_of = ZOrderKey::for_range(range.least, range.most);
  if (!key_of) return compared_order(sums);
  const int index_bits = static_cast<int>(std::bit_width(sums.size()));
  return key_of->bits() + index_bits <= 64 ? radix_order<Packed>(sums, *key_of, index_bits)
                                           : radix_order<Apart>(sums, *key_of, index_bits);
}

}  // namespace arris::tiling
