// How many neighbours the first few ask for.

#include "features/segment/neighbour_rule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace arris {
namespace {

/// Eight neighbours on a square grid around the query, `along` and `across` steps apart.
PackedNeighbours grid(double along, double across) {
  PackedNeighbours found;
  found.narrow = false;
  found.wide.reserve(kFewestNeighbours);
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      if (i == 0 && j == 0) continue;
      found.wide.dx[found.count] = i * along;
      found.wide.dy[found.count] = j * across;
      ++found.count;
    }
  }
  return found;
}

TEST(NeighboursFor, FollowTheNoiseBetween8And32) {
  EXPECT_EQ(neighbours_for(0.0), 8U);
  EXPECT_EQ(neighbours_for(0.13), 8U);
  EXPECT_EQ(neighbours_for(0.14), 12U);
  EXPECT_EQ(neighbours_for(0.22), 16U);
  EXPECT_EQ(neighbours_for(0.5), 32U);
  EXPECT_EQ(neighbours_for(1e300), 32U);
}

TEST(NeighbourRule, FixedNumber_IsWantedEverywhere) {
  const NeighbourRule rule(30);
  EXPECT_EQ(rule.least(), 30U);
  EXPECT_EQ(rule.wanted(grid(1.0, 1.0)), 30U);
}

TEST(NeighbourRule, NoNoise_NeedsTheFewest) {
  EXPECT_EQ(NeighbourRule(0.0, 32).wanted(grid(1.0, 1.0)), kFewestNeighbours);
}

TEST(NeighbourRule, DenserSurroundings_NeedMore) {
  const NeighbourRule rule(10.0, 32);
  EXPECT_EQ(rule.wanted(grid(200.0, 200.0)), 8U);
  EXPECT_EQ(rule.wanted(grid(50.0, 50.0)), 16U);
  EXPECT_EQ(rule.wanted(grid(20.0, 20.0)), 32U);
  EXPECT_EQ(NeighbourRule(10.0, 16).wanted(grid(20.0, 20.0)), 16U);
}

// A scan line: far apart along it, but the normal rests on what is across.
TEST(NeighbourRule, PointsAlongALine_NeedMore) {
  const NeighbourRule rule(10.0, 32);
  EXPECT_EQ(rule.wanted(grid(200.0, 50.0)), 8U);
  EXPECT_EQ(rule.wanted(grid(200.0, 0.5)), 32U);
  EXPECT_EQ(rule.wanted(grid(200.0, 0.0)), 32U);
}

}  // namespace
}  // namespace arris
