#include "tiling/z_order_key.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "tiling/voxel_order.h"

namespace arris::tiling {
namespace {

constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();

/// A range of one axis: often one that straddles a position of many trailing zeros.
std::pair<std::int32_t, std::int32_t> any_range(std::mt19937_64& random) {
  const std::int64_t width = std::int64_t{1} << random() % 21;
  const std::int64_t centre = random() % 3 == 0 ? static_cast<std::int32_t>(random())
                                                : (static_cast<std::int64_t>(random() % 5) - 2) << (10 + random() % 21);
  const auto clamped = [](std::int64_t v) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(v, kMin, kMax));
  };
  return {clamped(centre - static_cast<std::int64_t>(random() % width)),
          clamped(centre + static_cast<std::int64_t>(random() % width))};
}

RC_GTEST_PROP(ZOrderKey, KeysInRange_HaveTheOrderOfTheirPositions, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  const auto x = any_range(random), y = any_range(random), z = any_range(random);
  const auto key = ZOrderKey::for_range({x.first, y.first, z.first}, {x.second, y.second, z.second});
  if (!key) return;
  const auto within = [&](const std::pair<std::int32_t, std::int32_t>& range) {
    const auto width = static_cast<std::uint64_t>(std::int64_t{range.second} - range.first + 1);
    return static_cast<std::int32_t>(range.first + static_cast<std::int64_t>(random() % width));
  };
  for (int i = 0; i < 500; ++i) {
    LatticePoint a{within(x), within(y), within(z)}, b{within(x), within(y), within(z)};
    if (i % 3 == 0) b.x = a.x;
    if (i % 5 == 0) b.z = a.z;
    RC_ASSERT(((*key)(a) < (*key)(b)) == z_order_less(a, b));
    RC_ASSERT(((*key)(a) == (*key)(b)) == (a == b));
    RC_ASSERT((*key)(a) >> key->bits() == 0U);
  }
}

TEST(ZOrderKey, UsualExtents_HaveKeysAndHugeOnesHaveNone) {
  const std::int32_t most = 1 << 20;
  EXPECT_TRUE(ZOrderKey::for_range({-most, -most, -most}, {most - 1, most - 1, most - 1}));
  EXPECT_FALSE(ZOrderKey::for_range({-most - 1, 0, 0}, {most, 0, 0}));
  EXPECT_FALSE(ZOrderKey::for_range({kMin, kMin, kMin}, {kMax, kMax, kMax}));
  EXPECT_TRUE(ZOrderKey::for_range({kMin, kMax, 0}, {kMin, kMax, 0}));
}

RC_GTEST_PROP(VoxelOrder, AnySums_AreSorted, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  const auto x = any_range(random), y = any_range(random), z = any_range(random);
  std::vector<VoxelSums> sums(random() % 3000);
  const bool huge = random() % 4 == 0;  // Too far apart for 64 bits.
  for (VoxelSums& s : sums) {
    const auto within = [&](const std::pair<std::int32_t, std::int32_t>& range) {
      if (huge) return static_cast<std::int32_t>(random());
      const auto width = static_cast<std::uint64_t>(std::int64_t{range.second} - range.first + 1);
      return static_cast<std::int32_t>(range.first + static_cast<std::int64_t>(random() % width));
    };
    s.key = {within(x), within(y), within(z)};
    if (random() % 4 == 0) s.key = sums[random() % sums.size()].key;
  }
  const PageArray<std::uint32_t> sorted = z_order_of(sums);
  const std::span<const std::uint32_t> order = sorted.first(sums.size());
  for (std::size_t i = 1; i < order.size(); ++i) RC_ASSERT(!z_order_less(sums[order[i]].key, sums[order[i - 1]].key));
  std::vector<std::uint32_t> indices(order.begin(), order.end());
  std::ranges::sort(indices);
  for (std::size_t i = 0; i < indices.size(); ++i) RC_ASSERT(indices[i] == i);
}

}  // namespace
}  // namespace arris::tiling
