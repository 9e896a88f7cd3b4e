#include "tiling/query_regions.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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

RC_GTEST_PROP(QueryRegions, EveryPointOfAQuerysBox_IsContainedAndItsTilesAreTouched, ()) {
  QueryRegions regions;
  std::vector<Query> queries;
  const int count = *rc::gen::inRange(1, 30);
  for (int i = 0; i < count; ++i) {
    const auto coordinate = [] { return *rc::gen::inRange<std::int32_t>(-5000, 5000); };
    queries.push_back({{coordinate(), coordinate(), coordinate()}, *rc::gen::inRange<std::int64_t>(0, 600)});
    regions.add(queries.back().position, queries.back().reach);
  }
  for (const Query& query : queries) {
    const LatticeBox box = box_of(query);
    const auto inside = [&](int axis) {
      return static_cast<std::int32_t>(*rc::gen::inRange<std::int64_t>(box.min[axis], box.max[axis]));
    };
    const LatticePoint p{inside(0), inside(1), inside(2)};
    RC_ASSERT(regions.contains(p));
    RC_ASSERT(regions.contains({static_cast<std::int32_t>(box.min[0]), static_cast<std::int32_t>(box.min[1]),
                                static_cast<std::int32_t>(box.min[2])}));
    LatticeBox tile;
    tile.include(p);
    RC_ASSERT(regions.touches(tile));
  }
  // And what lies farther than two reaches from every query is left out.
  const LatticePoint p{*rc::gen::inRange<std::int32_t>(-9000, 9000), 0, 0};
  bool near = false;
  for (const Query& query : queries)
    near = near || box_of(query).expanded(std::max<std::int64_t>(query.reach, 1)).contains(p);
  if (!near) RC_ASSERT(!regions.contains(p));
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
