#include "tiling/leaf_index.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include "random_cloud.h"

namespace arris::tiling {
namespace {

constexpr int kFirstLevel = 3, kLastLevel = 20;

LatticePoint key_at(const LatticePoint& p, int level) {
  return {p.x >> level, p.y >> level, p.z >> level};
}

std::size_t leaves_at(const std::vector<LatticePoint>& points, int level) {
  std::set<std::array<std::int32_t, 3>> keys;
  for (const LatticePoint& p : points) {
    const LatticePoint key = key_at(p, level);
    keys.insert({key.x, key.y, key.z});
  }
  return keys.size();
}

RC_GTEST_PROP(LeafIndex, GroupsEveryPointOnceUnderItsLeafOfTheFirstSizeThatIsFilled, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const auto size = *rc::gen::inRange<std::size_t>(1, 3000);
  const auto per_leaf = *rc::gen::inRange<std::size_t>(1, 40);
  const std::vector<LatticePoint> points = test::random_cloud(seed, size);
  LeafIndex index(points, kFirstLevel, kLastLevel, per_leaf, 1);

  const std::size_t most = std::max<std::size_t>(points.size() / per_leaf, 1);
  int level = kFirstLevel;
  while (level < kLastLevel && leaves_at(points, level) > most) ++level;
  RC_ASSERT(!index.scattered());
  RC_ASSERT(index.level() == level);
  RC_ASSERT(index.size() == leaves_at(points, level));

  PageVector<std::uint32_t> order;
  std::vector<std::uint32_t> begin;
  index.group(order, begin);
  RC_ASSERT(begin.size() == index.size() + 1);
  RC_ASSERT(begin.front() == 0U);
  RC_ASSERT(begin.back() == points.size());
  for (std::size_t leaf = 0; leaf < index.size(); ++leaf) {
    RC_ASSERT(std::is_sorted(order.begin() + begin[leaf], order.begin() + begin[leaf + 1]));
    for (std::size_t i = begin[leaf]; i < begin[leaf + 1]; ++i)
      RC_ASSERT(key_at(points[order[i]], level) == key_at(index.origin(leaf), level));
  }
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i) RC_ASSERT(order[i] == i);
}

TEST(LeafIndex, PointsFartherApartThanTheLargestLeaf_AreScattered) {
  std::vector<LatticePoint> points;
  for (std::int32_t i = 0; i < 100; ++i) points.push_back({i << 10, 0, 0});
  EXPECT_TRUE(LeafIndex(points, 3, 8, 10, 2).scattered());
  EXPECT_FALSE(LeafIndex(points, 3, 14, 10, 2).scattered());
}

}  // namespace
}  // namespace arris::tiling
