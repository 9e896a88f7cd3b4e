// Rings of neighbours around queries against a search of all.

#include "features/segment/query_rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/tile_points.h"

namespace arris {
namespace {

const Lattice kMillimetres{0.001, {0.0, 0.0, 0.0}};

struct Scene {
  LatticePoints positions;
  PointIds ids;
  SegmentParameters parameters;

  explicit Scene(std::size_t points) {
    std::mt19937_64 random(3);
    std::uniform_int_distribution<std::int32_t> any(0, 9999), height(0, 20);
    for (std::size_t i = 0; i < points; ++i) {
      positions.push_back({any(random), any(random), height(random)});
      ids.push_back(i);
    }
    parameters.neighbours = 12;
    parameters.max_radius = 2.0;
  }
};

void expect_rings(const PointTree& tree, const TileNeighbourhoods& points, const QueryRings& rings, int count) {
  std::vector<int> expected(tree.size(), count + 1);
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot)
    if (rings.is_query(slot)) expected[slot] = 0;
  for (int ring = 0; ring < count; ++ring) {
    for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
      if (expected[slot] != ring) continue;
      for (const std::uint32_t neighbour : points.neighbours(slot))
        expected[neighbour] = std::min(expected[neighbour], ring + 1);
    }
  }
  std::size_t outside = 0;
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
    outside += expected[slot] > 0;
    for (std::uint8_t ring = 0; ring <= count; ++ring)
      ASSERT_EQ(rings.within(slot, ring), expected[slot] <= ring) << slot << " ring " << int{ring};
    ASSERT_EQ(points.state(slot) == ShapeState::kUnasked, expected[slot] > count);
  }
  EXPECT_GT(outside, 0U);
}

TEST(QueryRings, OfACore_AreTheNeighboursOfNeighbours) {
  const Scene scene(4000);
  const PointTree tree(scene.positions, scene.ids);
  for (const int count : {1, 2}) {
    TileNeighbourhoods points(tree, kMillimetres, scene.parameters);
    QueryRings rings(tree, LatticeBox{{2000, 1000, -100}, {7000, 8000, 100}});
    rings.compute(points, count);
    expect_rings(tree, points, rings, count);
  }
}

TEST(QueryRings, OfListedQueries_AreTheNeighboursOfNeighbours) {
  const Scene scene(4000);
  const PointTree tree(scene.positions, scene.ids);
  const std::vector<PlacedQuery> queries{{17, 100}, {400, 200}, {3999, 300}};
  TileNeighbourhoods points(tree, kMillimetres, scene.parameters);
  QueryRings rings(tree, queries);
  rings.compute(points, 2);
  expect_rings(tree, points, rings, 2);
  ASSERT_EQ(rings.listed().size(), queries.size());
  for (const auto& [slot, reach] : rings.listed()) {
    EXPECT_TRUE(rings.is_query(slot));
    EXPECT_EQ(reach, tree.entry(slot) == 17 ? 100 : tree.entry(slot) == 400 ? 200 : 300);
  }
}

}  // namespace
}  // namespace arris
