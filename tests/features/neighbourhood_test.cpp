// Tree, candidates, nearest neighbours and ball moments against brute force.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>
#include <type_traits>

#include "features/neighbourhood/ball_members.h"
#include "features/neighbourhood/ball_moments.h"
#include "features/neighbourhood/candidate_set.h"
#include "features/neighbourhood/distance_row.h"
#include "features/neighbourhood/local_spacing.h"
#include "features/neighbourhood/nearest_select.h"
#include "features/neighbourhood/outer_box.h"
#include "features/neighbourhood/packed_neighbours.h"
#include "features/neighbourhood/spacing_batch.h"
#include "random_clouds.h"

namespace arris {
namespace {

using test::random_positions;
using test::Shape;

PointTree tree_of(const TilePoints& tile) {
  return {tile.positions, tile.ids};
}

double exact_squared_distance(const ClosedBox& a, const ClosedBox& b) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap =
        std::max({static_cast<double>(a.min[axis]) - b.max[axis], static_cast<double>(b.min[axis]) - a.max[axis], 0.0});
    sum += gap * gap;
  }
  return sum;
}

TEST(PointTree, EveryEntry_IsInOneBucketInsideItsBox) {
  for (const std::size_t points : {1, 2, 33, 1000, 4097}) {
    const TilePoints tile = test::tile_of(random_positions(Shape::kVolume, points, 5000.0, points), 1);
    const PointTree tree = tree_of(tile);
    ASSERT_EQ(tree.size(), tile.positions.size());
    std::vector<int> seen(tree.size());
    const ClosedBox all{{INT32_MIN, INT32_MIN, INT32_MIN}, {INT32_MAX, INT32_MAX, INT32_MAX}};
    std::vector<std::uint32_t> buckets;
    tree.buckets_near(all, 0.0, buckets);
    for (const std::uint32_t bucket : buckets) {
      const std::size_t begin = tree.bucket_begin(bucket), end = tree.bucket_begin(bucket + 1);
      const OuterBox box = tree.bucket_box(bucket);
      EXPECT_LE(end - begin, 32U);
      for (std::size_t slot = begin; slot < end; ++slot) {
        ++seen[tree.entry(slot)];
        EXPECT_EQ(tree.position(slot), tile.positions[tree.entry(slot)]);
        EXPECT_EQ(tree.id(slot), tile.ids[tree.entry(slot)]);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GE(tree.position(slot)[axis], box.min[axis]);
          EXPECT_LE(tree.position(slot)[axis], box.max[axis]);
          EXPECT_LE(box.max[axis] - box.min[axis], tree.longest_bucket());
        }
      }
    }
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  }
}

TEST(NodeBoxes, LeavesNear_AreThoseWithinReach) {
  std::mt19937_64 bits(5);
  const auto below = [&](std::uint64_t end) { return static_cast<std::int32_t>(bits() % end); };
  for (int depth = 0; depth <= 10; ++depth) {
    const std::size_t leaves = std::size_t{1} << depth;
    NodeBoxes boxes(depth);
    std::vector<ClosedBox> of_nodes(2 * leaves);
    for (std::size_t node = 2 * leaves - 1; node > 0; --node) {
      ClosedBox& box = of_nodes[node];
      for (int axis = 0; axis < 3; ++axis) {
        if (node >= leaves) {
          box.min[axis] = below(2000) - 1000;
          box.max[axis] = box.min[axis] + below(100);
        } else {
          box.min[axis] = std::min(of_nodes[2 * node].min[axis], of_nodes[2 * node + 1].min[axis]);
          box.max[axis] = std::max(of_nodes[2 * node].max[axis], of_nodes[2 * node + 1].max[axis]);
        }
      }
      boxes.set(node, OuterBox(box));
    }
    for (const double reach : {0.0, 200.0, 600.0, 5000.0}) {
      const ClosedBox asked{{-30, 10, -200}, {40, 60, 100}};
      std::vector<std::uint32_t> expected, found;
      for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
        if (exact_squared_distance(of_nodes[leaves + leaf], asked) <= reach * reach) {
          expected.push_back(static_cast<std::uint32_t>(leaf));
        }
      }
      boxes.leaves_near(OuterBox(asked), reach, found);
      EXPECT_EQ(found, expected) << depth << " " << reach;
    }
  }
}

TEST(OuterBox, Distance_IsExactForSmallCoordinates) {
  const auto distance = [](const ClosedBox& a, const ClosedBox& b) {
    return squared_distance(OuterBox(a), OuterBox(b));
  };
  EXPECT_EQ(distance({{0, 0, 0}, {1, 1, 1}}, {{4, 1, -3}, {5, 2, -2}}), 9.0F + 0.0F + 4.0F);
  EXPECT_EQ(distance({{0, 0, 0}, {9, 9, 9}}, {{2, 3, 4}, {2, 3, 4}}), 0.0F);
}

TEST(OuterBox, AnyBox_IsInsideAndNoDistanceIsTooLong) {
  std::mt19937_64 random(8);
  std::uniform_int_distribution<std::int32_t> any(INT32_MIN, INT32_MAX);
  const auto random_box = [&] {
    ClosedBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = any(random);
      box.max[axis] = std::max(box.min[axis], any(random) / 16);
    }
    return box;
  };
  const ClosedBox ends[] = {{{INT32_MIN, INT32_MIN, INT32_MIN}, {INT32_MIN, INT32_MIN, INT32_MIN}},
                            {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MAX, INT32_MAX, INT32_MAX}}};
  for (int round = 0; round < 1000; ++round) {
    const ClosedBox a = round < 2 ? ends[round] : random_box();
    const ClosedBox b = round < 2 ? ends[1 - round] : random_box();
    const OuterBox outer(a);
    double exact = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LE(static_cast<double>(outer.min[axis]), a.min[axis]);
      ASSERT_GE(static_cast<double>(outer.max[axis]), a.max[axis]);
      const double gap = std::max(
          {static_cast<double>(a.min[axis]) - b.max[axis], static_cast<double>(b.min[axis]) - a.max[axis], 0.0});
      exact += gap * gap;
    }
    ASSERT_LE(squared_distance(outer, OuterBox(b)), exact * (1.0 + kBoxDistanceError));
  }
}

template <class T>
class Kernels : public testing::Test {};
using Arithmetics = testing::Types<float, double, std::int64_t>;
TYPED_TEST_SUITE(Kernels, Arithmetics);

TYPED_TEST(Kernels, Gathering_HoldsEveryPointInReach) {
  for (const Shape shape : {Shape::kPlane, Shape::kVolume, Shape::kDensityStep, Shape::kCollinear}) {
    const TilePoints tile = test::tile_of(random_positions(shape, 2000, 3000.0, 7), 1);
    const PointTree tree = tree_of(tile);
    CandidateSet<TypeParam> candidates;
    const ClosedBox box{{-50, -20, -10}, {100, 90, 30}};
    for (const double reach : {0.0, 40.5, 400.0}) {
      ASSERT_TRUE(candidates.gather(tree, box, reach));
      std::vector<int> have(tree.size());
      for (std::size_t i = 0; i < candidates.count; ++i) {
        const std::uint32_t slot = candidates.slot[i];
        ++have[slot];
        EXPECT_EQ(static_cast<std::int64_t>(candidates.x[i]) + candidates.origin[0], tree.position(slot).x);
        EXPECT_EQ(static_cast<std::int64_t>(candidates.y[i]) + candidates.origin[1], tree.position(slot).y);
        EXPECT_EQ(static_cast<std::int64_t>(candidates.z[i]) + candidates.origin[2], tree.position(slot).z);
      }
      for (std::size_t slot = 0; slot < tree.size(); ++slot) {
        const LatticePoint p = tree.position(slot);
        const double d2 = exact_squared_distance(box, {{p.x, p.y, p.z}, {p.x, p.y, p.z}});
        EXPECT_LE(have[slot], 1);
        if (d2 <= reach * reach) {
          EXPECT_EQ(have[slot], 1);
        }
        if (d2 > (reach + 1.001) * (reach + 1.001)) {
          EXPECT_EQ(have[slot], 0);
        }
      }
    }
  }
}

TYPED_TEST(Kernels, Nearest_AgreeWithSortingAll) {
  for (const Shape shape : {Shape::kPlane, Shape::kGrid, Shape::kVolume}) {
    const TilePoints tile = test::tile_of(random_positions(shape, 700, 600.0, 9), 1);
    const PointTree tree = tree_of(tile);
    CandidateSet<TypeParam> candidates;
    const ClosedBox all{{-2000, -2000, -2000}, {4000, 4000, 4000}};
    ASSERT_TRUE(candidates.gather(tree, all, 0.0));
    ASSERT_EQ(candidates.count, tree.size());
    candidates.pack();
    NearestScratch<TypeParam> scratch;
    Neighbours found;
    found.reserve(200);
    PackedNeighbours packed;
    packed.reserve(200);
    for (std::size_t slot = 0; slot < tree.size(); slot += 37) {
      const LatticePoint at = tree.position(slot);
      std::vector<std::pair<std::uint64_t, std::uint64_t>> sorted;
      std::vector<LatticePoint> position_of_id(tree.size() * 2 + 2000);
      for (std::size_t other = 0; other < tree.size(); ++other) {
        position_of_id[tree.id(other)] = tree.position(other);
        if (other != slot) sorted.emplace_back(squared_distance(at, tree.position(other)), tree.id(other));
      }
      std::sort(sorted.begin(), sorted.end());
      for (const std::size_t k : {std::size_t{1}, std::size_t{30}, std::size_t{200}}) {
        for (const int guess : {0, 100, 100000}) {
          for (const int most : {5000, 10000000}) {
            NearestQuery<TypeParam> query;
            query.x = static_cast<TypeParam>(at.x - candidates.origin[0]);
            query.y = static_cast<TypeParam>(at.y - candidates.origin[1]);
            query.z = static_cast<TypeParam>(at.z - candidates.origin[2]);
            query.k = k;
            query.max_d2 = static_cast<TypeParam>(most);
            query.guess_d2 = static_cast<TypeParam>(guess);
            select_nearest(tree, candidates, query, scratch, found);
            std::size_t expected = 0;
            while (expected < k && expected < sorted.size() &&
                   sorted[expected].first <= static_cast<std::uint64_t>(most))
              ++expected;
            ASSERT_EQ(found.count, expected);
            for (std::size_t i = 0; i < expected; ++i) {
              ASSERT_EQ(found.d2[i], static_cast<double>(sorted[i].first));
              const LatticePoint p = position_of_id[sorted[i].second];
              ASSERT_EQ(found.dx[i], p.x - at.x);
              ASSERT_EQ(found.dy[i], p.y - at.y);
              ASSERT_EQ(found.dz[i], p.z - at.z);
            }
            if (expected > 0) {
              EXPECT_EQ(found.last_d2, sorted[expected - 1].first);
            }
            select_nearest(tree, candidates, query, scratch, packed);
            ASSERT_EQ(packed.count, found.count);
            ASSERT_EQ(packed.last_d2, found.last_d2);
            for (std::size_t i = 0; i < expected; ++i) {
              ASSERT_EQ(packed.slot(i), found.slot[i]);
              const auto [x, y, z] = packed.offset(i);
              ASSERT_TRUE(x == found.dx[i] && y == found.dy[i] && z == found.dz[i]);
            }
          }
        }
      }
    }
  }
}

/// Sums of the larger balls go on in double after a few vectors of floats, or are made in double at once.
TYPED_TEST(Kernels, BallMoments_AreExact) {
  struct Case {
    double extent, radius;
  };
  for (const auto [extent, radius] : {Case{800.0, 0.0},
                                      {800.0, 3.0},
                                      {800.0, 60.7},
                                      {800.0, 250.0},
                                      {800.0, 700.0},
                                      {1600.0, 1400.0},
                                      {1700.0, 1500.0},
                                      {5000.0, 4000.0}}) {
    const TilePoints tile = test::tile_of(random_positions(Shape::kFold, 1500, extent, 10), 1);
    const PointTree tree = tree_of(tile);
    CandidateSet<TypeParam> candidates;
    const LatticePoint centre = tree.position(77);
    const ClosedBox box{{centre.x, centre.y, centre.z}, {centre.x, centre.y, centre.z}};
    ASSERT_TRUE(candidates.gather(tree, box, radius));
    ASSERT_TRUE(ball_sums_are_exact<TypeParam>(radius));
    const auto radius2 = static_cast<std::uint64_t>(radius * radius);
    BallQuery<TypeParam> ball{static_cast<TypeParam>(centre.x - candidates.origin[0]),
                              static_cast<TypeParam>(centre.y - candidates.origin[1]),
                              static_cast<TypeParam>(centre.z - candidates.origin[2]), static_cast<TypeParam>(radius2)};
    std::int64_t n = 0;
    std::int64_t sums[9] = {};
    const std::array<Vector3, 2> directions{Vector3{0.36, 0.48, 0.8}, Vector3{0.8, -0.6, 0.0}};
    double low[2] = {};
    double high[2] = {};
    for (const LatticePoint& p : tile.positions) {
      if (squared_distance(p, centre) > radius2) continue;
      const std::int64_t x = p.x - centre.x;
      const std::int64_t y = p.y - centre.y;
      const std::int64_t z = p.z - centre.z;
      const std::int64_t terms[9] = {x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
      for (int t = 0; t < 9; ++t) sums[t] += terms[t];
      ++n;
      for (std::size_t e = 0; e < 2; ++e) {
        const double along =
            dot(directions[e], {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        low[e] = std::min(low[e], along);
        high[e] = std::max(high[e], along);
      }
    }
    const BallMoments m = ball_moments(candidates, ball);
    const double found[10] = {m.n, m.x, m.y, m.z, m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
    EXPECT_EQ(found[0], static_cast<double>(n));
    for (int t = 0; t < 9; ++t) EXPECT_EQ(found[t + 1], static_cast<double>(sums[t])) << t;
    const auto extents = extent_bounds(candidates, ball, directions[0], directions[1]);
    for (std::size_t e = 0; e < 2; ++e) {
      EXPECT_GE(extents[e].most, high[e] - low[e]);
      EXPECT_LE(extents[e].least, high[e] - low[e]);
      EXPECT_GE(extents[e].least, 0.0);
    }
    std::vector<std::uint32_t> members;
    EXPECT_EQ(ball_members(candidates, ball, members), static_cast<std::size_t>(n));
  }
}

TYPED_TEST(Kernels, SpacingBatch_GivesTheSpacingOfTheNeighbours) {
  using Key = std::conditional_t<std::is_same_v<TypeParam, float>, std::int32_t, std::int64_t>;
  constexpr std::size_t kNeighbours = SpacingBatch<Key>::kNeighbours;
  for (const Shape shape : {Shape::kGrid, Shape::kFold}) {  // Grids are full of ties.
    const TilePoints tile = test::tile_of(random_positions(shape, 900, 600.0, 3), 1);
    const PointTree tree = tree_of(tile);
    const LatticePoint middle = tree.position(450);
    CandidateSet<TypeParam> candidates;
    ASSERT_TRUE(candidates.gather(tree, {{middle.x, middle.y, middle.z}, {middle.x, middle.y, middle.z}}, 1500.0));
    candidates.pack();
    NearestScratch<TypeParam> scratch;
    Neighbours neighbours;
    neighbours.reserve(kNeighbours);
    for (const int guess : {1, 900, 20000, 1000000}) {  // Too little, and so much that rows overflow.
      SpacingBatch<Key> batch;
      std::vector<LocalSpacing> spacings;
      std::vector<std::uint64_t> last;
      for (std::size_t i = 0; i < SpacingBatch<Key>::kCount; ++i) {
        const LatticePoint at = tree.position(55 * i);
        NearestQuery<TypeParam> query;
        query.x = static_cast<TypeParam>(at.x - candidates.origin[0]);
        query.y = static_cast<TypeParam>(at.y - candidates.origin[1]);
        query.z = static_cast<TypeParam>(at.z - candidates.origin[2]);
        query.k = kNeighbours;
        query.max_d2 = 1000000;
        query.guess_d2 = static_cast<TypeParam>(guess);
        DistanceRow row;
        select_nearest(tree, candidates, query, scratch, neighbours);
        select_nearest(tree, candidates, query, scratch, row);
        ASSERT_EQ(row.count, neighbours.count);
        ASSERT_EQ(row.count, kNeighbours);
        ASSERT_EQ(row.narrow, sizeof(Key) == 4);
        if constexpr (sizeof(Key) == 4) {
          batch.set(i, row.narrow_d2);
        } else {
          batch.set(i, row.wide_d2);
        }
        spacings.push_back(local_spacing(neighbours));
        last.push_back(neighbours.last_d2);
      }
      batch.solve();
      for (std::size_t i = 0; i < spacings.size(); ++i) {
        EXPECT_EQ(batch.density(i), spacings[i].density);
        EXPECT_EQ(static_cast<std::uint64_t>(batch.last_d2(i)), last[i]);
      }
    }
  }
}

TYPED_TEST(Kernels, DistanceRow_OfFewPoints_CountsThem) {
  const TilePoints tile = test::tile_of({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {900, 0, 0}}, 1);
  const PointTree tree = tree_of(tile);
  CandidateSet<TypeParam> candidates;
  ASSERT_TRUE(candidates.gather(tree, {{0, 0, 0}, {0, 0, 0}}, 10.0));
  NearestScratch<TypeParam> scratch;
  DistanceRow row;
  NearestQuery<TypeParam> query{0, 0, 0, 20, 100, 1};
  select_nearest(tree, candidates, query, scratch, row);
  EXPECT_EQ(row.count, 2U);
  query.k = 1;
  select_nearest(tree, candidates, query, scratch, row);
  EXPECT_EQ(row.count, 1U);
}

TEST(BallMoments, SumsBeyondFloat_AreExactFromFloats) {
  // Squares add up to 400 times 2^22, which floats do not hold.
  std::vector<LatticePoint> positions{{0, 0, 0}};
  for (std::int32_t i = 0; i < 400; ++i) positions.push_back({2047 - i % 3, -2000 + i, i % 2 == 0 ? 1999 : -1801 + i});
  const TilePoints tile = test::tile_of(positions, 1);
  const PointTree tree = tree_of(tile);
  CandidateSet<float> floats;
  CandidateSet<double> doubles;
  const ClosedBox box{{0, 0, 0}, {0, 0, 0}};
  constexpr double kRadius = 4000.0;
  ASSERT_TRUE(floats.gather(tree, box, kRadius));
  ASSERT_TRUE(doubles.gather(tree, box, kRadius));
  ASSERT_TRUE(ball_sums_are_exact<float>(kRadius));
  const BallMoments a = ball_moments(floats, {0, 0, 0, static_cast<float>(kRadius * kRadius)});
  const BallMoments b = ball_moments(doubles, {0, 0, 0, kRadius * kRadius});
  EXPECT_EQ(a.n, 401.0);
  EXPECT_EQ(std::tie(a.n, a.x, a.y, a.z, a.xx, a.xy, a.xz, a.yy, a.yz, a.zz),
            std::tie(b.n, b.x, b.y, b.z, b.xx, b.xy, b.xz, b.yy, b.yz, b.zz));
}

TEST(BallMoments, FromProducts_AreTheSame) {
  const TilePoints tile = test::tile_of(
      [] {
        std::vector<LatticePoint> positions;
        for (std::int32_t i = 0; i < 500; ++i) positions.push_back({i * 37 % 611, i * 101 % 499, i * 13 % 83});
        return positions;
      }(),
      1);
  const PointTree tree = tree_of(tile);
  CandidateSet<float> plain, multiplied;
  const ClosedBox box{{100, 120, 0}, {300, 351, 80}};
  constexpr double kRadius = 250.0;
  ASSERT_TRUE(plain.gather(tree, box, kRadius));
  ASSERT_TRUE(multiplied.gather(tree, box, kRadius));
  multiplied.multiply();
  ASSERT_TRUE(multiplied.products.exact);
  const auto expect_same = [&] {
    for (const BallQuery<float>& ball :
         {BallQuery<float>{-100, 115, 40, 62500}, BallQuery<float>{77, -90, -33, 10000}}) {
      const BallMoments a = ball_moments(plain, ball);
      const BallMoments b = ball_moments(multiplied, ball);
      EXPECT_GT(a.n, 1.0);
      EXPECT_EQ(std::tie(a.n, a.x, a.y, a.z, a.xx, a.xy, a.xz, a.yy, a.yz, a.zz),
                std::tie(b.n, b.x, b.y, b.z, b.xx, b.xy, b.xz, b.yy, b.yz, b.zz));
    }
  };
  EXPECT_TRUE(multiplied.products.whole);
  expect_same();
  const auto pretend = [&](double farthest) {
    multiplied.products.make(multiplied.x, multiplied.y, multiplied.z, multiplied.count, farthest);
  };
  pretend(4e3);  // A lane could hold the sum, all lanes together could not.
  ASSERT_TRUE(multiplied.products.exact);
  EXPECT_FALSE(multiplied.products.whole);
  expect_same();
  pretend(4e4);
  EXPECT_FALSE(multiplied.products.exact);
}

TEST(CandidateSet, CoordinatesTooLargeForFloat_AreRefused) {
  const TilePoints tile = test::tile_of({{0, 0, 0}, {20000000, 1, 2}}, 1);
  const PointTree tree = tree_of(tile);
  CandidateSet<float> floats;
  CandidateSet<double> doubles;
  const ClosedBox box{{0, 0, 0}, {0, 0, 0}};
  EXPECT_FALSE(floats.gather(tree, box, 3.0));
  EXPECT_TRUE(doubles.gather(tree, box, 3.0));
  EXPECT_EQ(doubles.count, 1U);
}

TEST(LocalSpacing, RegularGrid_IsThePitch) {
  const std::vector<LatticePoint> grid = random_positions(Shape::kGrid, 900, 3000.0, 1);
  const TilePoints tile = test::tile_of(grid, 1);
  const PointTree tree = tree_of(tile);
  CandidateSet<double> candidates;
  ASSERT_TRUE(candidates.gather(tree, {{0, 0, 0}, {3000, 3000, 0}}, 0.0));
  NearestScratch<double> scratch;
  Neighbours found;
  found.reserve(30);
  for (std::size_t i = 0; i < candidates.count; ++i) {
    if (std::fabs(candidates.x[i]) > 100 || std::fabs(candidates.y[i]) > 100) continue;
    select_nearest(tree, candidates, {candidates.x[i], candidates.y[i], candidates.z[i], 30, 1e7, 90000.0}, scratch,
                   found);
    const LocalSpacing spacing = local_spacing(found);
    EXPECT_NEAR(spacing.nearest, 100.0 * (4 + 2 * std::sqrt(2.0)) / 6.0, 1e-9);
    EXPECT_NEAR(spacing.density, 100.0, 4.0);
  }
}

TEST(LocalSpacing, FewNeighbours_AreUsedAsTheyAre) {
  Neighbours found;
  found.reserve(8);
  EXPECT_EQ(local_spacing(found).density, 0.0);
  found.count = 1;
  found.d2[0] = 25.0;
  EXPECT_EQ(local_spacing(found).nearest, 5.0);
  EXPECT_NEAR(local_spacing(found).density, 5.0 * std::sqrt(3.14159265358979), 1e-9);
}

}  // namespace
}  // namespace arris
