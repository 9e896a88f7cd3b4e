/// @file Tile files go when nothing can ask for them any more, and not before.

#include "pipeline/tile_retirement.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace arris::pipeline {
namespace {

/// A grid of `side` x `side` tiles of 100 steps.
tiling::TilePlan grid_plan(std::int64_t side) {
  tiling::TilePlan plan;
  for (std::int64_t x = 0; x < side; ++x) {
    for (std::int64_t y = 0; y < side; ++y) {
      tiling::PlannedTile tile;
      tile.core = {{100 * x, 100 * y, 0}, {100 * x + 100, 100 * y + 100, 100}};
      plan.tiles.push_back(tile);
    }
  }
  return plan;
}

UnprovenQuery query_in(const tiling::PlannedTile& tile, std::int64_t reach, std::int64_t most) {
  return {0,
          {static_cast<std::int32_t>(tile.core.min[0] + 50), static_cast<std::int32_t>(tile.core.min[1] + 50), 50},
          reach,
          most};
}

bool reaches(const UnprovenQuery& query, std::int64_t reach, const tiling::PlannedTile& tile) {
  LatticeBox box;
  box.include(query.position);
  return box.expanded(reach).intersects(tile.core);
}

// The law by brute force: in any order of tiles, with any queries, a file is there as long as a query that came or may
// still come reaches it, and is gone at the end otherwise.
RC_GTEST_PROP(TileRetirement, AnyOrder_FilesGoWhenNoQueryCanReachThem, ()) {
  const auto plan = grid_plan(*rc::gen::inRange<std::int64_t>(1, 6).as("side"));
  const auto farthest = *rc::gen::inRange<std::int64_t>(0, 250).as("farthest");
  const bool asks_again = *rc::gen::arbitrary<bool>().as("asks again");
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("seed"));
  std::vector<std::size_t> order(plan.tiles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), random);

  TileRetirement retirement(plan, farthest, asks_again);
  std::vector<UnprovenQuery> asked;
  std::set<std::size_t> analysed, gone;
  for (const std::size_t tile : order) {
    std::vector<UnprovenQuery> unproven;
    if (farthest > 0 && random() % 4 == 0)
      unproven.push_back(query_in(plan.tiles[tile], static_cast<std::int64_t>(random() % farthest),
                                  static_cast<std::int64_t>(random() % 3 * random() % (2 * farthest))));
    asked.insert(asked.end(), unproven.begin(), unproven.end());
    analysed.insert(tile);
    for (const std::size_t now : retirement.analysed(tile, unproven)) RC_ASSERT(gone.insert(now).second);
    for (std::size_t t = 0; t < plan.tiles.size(); ++t) {
      const bool may_be_asked = std::any_of(asked.begin(), asked.end(), [&](const UnprovenQuery& query) {
        const std::int64_t most = query.most_reach_steps > 0 ? std::min(query.most_reach_steps, farthest) : farthest;
        return reaches(query, asks_again ? most : query.reach_steps, plan.tiles[t]);
      });
      bool will_be_asked = false;
      for (std::size_t other = 0; other < plan.tiles.size(); ++other) {
        will_be_asked |=
            !analysed.contains(other) && plan.tiles[other].core.expanded(farthest).intersects(plan.tiles[t].core);
      }
      RC_ASSERT(gone.contains(t) == (!may_be_asked && !will_be_asked));
    }
  }
}

TEST(TileRetirement, TilesWithinReachOfEachOther_AreAllKept) {
  const auto plan = grid_plan(20);
  TileRetirement retirement(plan, 100'000, true);
  for (std::size_t tile = 0; tile < plan.tiles.size(); ++tile) EXPECT_TRUE(retirement.analysed(tile, {}).empty());
}

}  // namespace
}  // namespace arris::pipeline
