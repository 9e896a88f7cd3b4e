#include "tiling/query_regions.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace arris::tiling {
namespace {

struct Query {
  LatticePoint position;
  std::int64_t reach;
};

LatticeBox box_of(const Query& query) {
  LatticeBox box;
  box.include(query.position);
  return box.expanded(query.reach);
}

bool holds(const Query& query, const LatticePoint& p) {
  std::int64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t d = std::int64_t{p[axis]} - query.position[axis];
    sum += d * d;
  }
  return sum <= query.reach * query.reach;
}

RC_GTEST_PROP(QueryRegions, PointsAndBoxes_AreThoseOfTheBalls, ()) {
  QueryRegions regions;
  std::vector<Query> queries;
  const int count = *rc::gen::inRange(1, 30);
  for (int i = 0; i < count; ++i) {
    const auto coordinate = [] { return *rc::gen::inRange<std::int32_t>(-3000, 3000); };
    queries.push_back({{coordinate(), coordinate(), coordinate()}, *rc::gen::inRange<std::int64_t>(0, 600)});
    regions.add(queries.back().position, queries.back().reach);
  }
  for (const Query& query : queries) {
    RC_ASSERT(regions.contains(query.position));
    const LatticeBox box = box_of(query).expanded(20);
    const auto inside = [&](int axis) {
      return static_cast<std::int32_t>(*rc::gen::inRange<std::int64_t>(box.min[axis], box.max[axis]));
    };
    const LatticePoint p{inside(0), inside(1), inside(2)};
    const auto any_holds = [&](const LatticePoint& at) {
      return std::ranges::any_of(queries, [&](const Query& q) { return holds(q, at); });
    };
    RC_ASSERT(regions.contains(p) == any_holds(p));
    LatticeBox one;
    one.include(p);
    RC_ASSERT(regions.touches(one) == any_holds(p));
    // A box is touched if its position nearest to some centre is held.
    const std::int64_t size = *rc::gen::element<std::int64_t>(3, 50, 700, 5000);
    const LatticeBox tile = one.expanded(size);
    bool touched = false;
    for (const Query& q : queries) {
      const auto nearest = [&](int axis) {
        return static_cast<std::int32_t>(
            std::clamp<std::int64_t>(q.position[axis], tile.min[axis], tile.max[axis] - 1));
      };
      touched = touched || holds(q, {nearest(0), nearest(1), nearest(2)});
    }
    RC_ASSERT(regions.touches(tile) == touched);
  }
}

TEST(QueryRegions, QueriesAtTheEndsOfTheLattice_Work) {
  constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
  QueryRegions regions;
  EXPECT_FALSE(regions.contains({0, 0, 0}));
  regions.add({kMin, kMin, kMin}, 1 << 30);
  regions.add({kMax, kMax, kMax}, 0);
  EXPECT_TRUE(regions.contains({kMin, kMin, kMin}));
  EXPECT_TRUE(regions.contains({kMax, kMax, kMax}));
  EXPECT_FALSE(regions.contains({kMax - 1, kMax, kMax}));
}

}  // namespace
}  // namespace arris::tiling
