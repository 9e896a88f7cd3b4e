// The laws of extract_liu: equal to the brute-force reference, and independent of everything but points and parameters.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include "core/columns.h"
#include "core/error.h"
#include "core/parallel.h"
#include "features/liu/liu_engine.h"
#include "liu_reference.h"
#include "random_clouds.h"
#include "tile_laws.h"

namespace arris {

namespace {

using test::any;
using test::anywhere;
using test::everything;
using test::expect_equal;
using test::merge;
using test::part_of;
using test::random_positions;
using test::reference_liu;
using test::reordered;
using test::Shape;
using test::tile_of;

const Lattice kMillimetres{0.001, {0.0, 0.0, 0.0}};

struct Cloud {
  Shape shape;
  std::vector<LatticePoint> positions;
  LiuParameters parameters;
  std::uint64_t seed;
};

/// A cloud of `points` points and parameters that find something in it.
Cloud any_cloud(std::size_t points) {
  Cloud cloud;
  cloud.shape = static_cast<Shape>(any(0, static_cast<int>(Shape::kLast) + 1));
  cloud.seed = *rc::gen::arbitrary<std::uint64_t>();
  const double extent = *rc::gen::element(40.0, 1000.0, 30000.0);
  cloud.positions = random_positions(cloud.shape, points, extent, cloud.seed);
  LiuParameters& p = cloud.parameters;
  p.k_min = any(3, 20);
  p.k_max = p.k_min + any(0, 14);
  p.k_step = any(1, 4);
  p.covariance_with_target = *rc::gen::arbitrary<bool>();
  p.gap_deg = *rc::gen::element(60.0, 90.0, 120.0, 200.0);
  p.radius_factor = *rc::gen::element(3.0, 6.0);
  p.cf1_factor = *rc::gen::element(0.3, 0.6, 1.0);
  p.cf2 = *rc::gen::element(1.0, 1.5, 4.0);
  p.top_m = any(1, 6);
  p.emit = *rc::gen::element(LiuParameters::Emit::kEmit, LiuParameters::Emit::kSelf);
  p.max_radius = extent * 0.001 * *rc::gen::element(0.12, 0.4, 5.0);
  p.spacing = *rc::gen::element(0.0, 0.0, 0.8) * extent * 0.001 / std::sqrt(static_cast<double>(points));
  RC_CLASSIFY(true, test::name(cloud.shape));
  return cloud;
}

TileContours run(const TilePoints& tile, const LiuParameters& p) {
  return extract_liu(tile, kMillimetres, p);
}

RC_GTEST_PROP(LiuMethod, AnyCloud_EqualsReference, ()) {
  const Cloud cloud = any_cloud(any<std::size_t>(1, 500));
  const TilePoints tile = tile_of(cloud.positions, cloud.seed);
  const TileContours found = run(tile, cloud.parameters);
  RC_ASSERT(found.unproven.empty());
  expect_equal(found, reference_liu(tile, kMillimetres, cloud.parameters));
}

RC_GTEST_PROP(LiuMethod, EarlyRejectionOff_ChangesNothing, ()) {
  const Cloud cloud = any_cloud(600);
  const TilePoints tile = tile_of(cloud.positions, cloud.seed);
  LiuSwitches switches;
  switches.early_rejection = false;
  expect_equal(run(tile, cloud.parameters), extract_liu_with(tile, kMillimetres, cloud.parameters, nullptr, switches));
}

RC_GTEST_PROP(LiuMethod, WiderArithmetic_ChangesNothing, ()) {
  const Cloud cloud = any_cloud(600);
  const TilePoints tile = tile_of(cloud.positions, cloud.seed);
  for (const auto narrowest : {Arithmetic::kDouble, Arithmetic::kInt64}) {
    LiuSwitches switches;
    switches.narrowest = narrowest;
    expect_equal(run(tile, cloud.parameters),
                 extract_liu_with(tile, kMillimetres, cloud.parameters, nullptr, switches));
  }
}

RC_GTEST_PROP(LiuMethod, Translation_ChangesNothing, ()) {
  const Cloud cloud = any_cloud(400);
  const LatticePoints moved = anywhere(cloud.positions);
  expect_equal(run(tile_of(cloud.positions, cloud.seed), cloud.parameters),
               run(tile_of(moved, cloud.seed), cloud.parameters));
}

RC_GTEST_PROP(LiuMethod, OrderOfEntries_ChangesNothing, ()) {
  const Cloud cloud = any_cloud(500);
  const TilePoints tile = tile_of(cloud.positions, cloud.seed);
  expect_equal(run(tile, cloud.parameters), run(reordered(tile, cloud.seed), cloud.parameters));
}

RC_GTEST_PROP(LiuMethod, SplitIntoTiles_MergesToTheWhole, ()) {
  const Cloud cloud = any_cloud(700);
  const TilePoints whole = tile_of(cloud.positions, cloud.seed);
  LatticeBox bounds;
  for (const LatticePoint& p : whole.positions) bounds.include(p);
  const std::int64_t cut = any(bounds.min[0], bounds.max[0] + 1);
  const std::int64_t halo = *rc::gen::element<std::int64_t>(0, 5, 30, 200);
  std::map<std::uint64_t, ContourRecord> merged;
  TileContours split;
  for (const bool upper : {false, true}) {
    LatticeBox core = everything();
    (upper ? core.min : core.max)[0] = cut;
    TileContours part = run(part_of(whole, core, halo), cloud.parameters);
    merge(merged, part.records);
    split.isolated += part.isolated;
    for (const UnprovenQuery& query : part.unproven) {
      RC_ASSERT(query.reach_steps <= static_cast<std::int64_t>(std::ceil(cloud.parameters.max_radius * 1000.0)) + 1);
      const TileContours again = run(part_of(whole, query), cloud.parameters);
      RC_ASSERT(again.unproven.empty());
      merge(merged, again.records);
      split.isolated += again.isolated;
    }
  }
  for (const auto& [id, record] : merged) split.records.push_back(record);
  expect_equal(split, run(whole, cloud.parameters));
}

RC_GTEST_PROP(LiuMethod, QueriesInTwoParts_MergeToTheWhole, ()) {
  const Cloud cloud = any_cloud(500);
  const TilePoints tile = tile_of(cloud.positions, cloud.seed);
  std::vector<std::uint32_t> parts[2];
  for (std::uint32_t i = 0; i < tile.positions.size(); ++i) parts[any(0, 2)].push_back(i);
  std::map<std::uint64_t, ContourRecord> merged;
  TileContours both;
  for (const auto& part : parts) {
    const TileContours found = extract_liu(tile, kMillimetres, cloud.parameters, part);
    merge(merged, found.records);
    both.isolated += found.isolated;
  }
  for (const auto& [id, record] : merged) both.records.push_back(record);
  expect_equal(both, run(tile, cloud.parameters));
}

TEST(LiuMethod, NumberOfThreads_ChangesNothing) {
  for (const Shape shape : {Shape::kFold, Shape::kGridFold, Shape::kDensityStep}) {
    const TilePoints tile = tile_of(random_positions(shape, 20000, 4000.0, 3), 3);
    LiuParameters p;
    p.max_radius = 2.0;
    p.cf1_factor = 0.5;
    ContourRecords records[2];
    int index = 0;
    for (const int threads : {1, 4}) {
      const ThreadLimit limit(threads);
      records[index++] = run(tile, p).records;
    }
    ASSERT_FALSE(records[0].empty());
    EXPECT_EQ(records[0], records[1]) << name(shape);
  }
}

TEST(LiuMethod, EmptyTile_FindsNothing) {
  TilePoints tile;
  tile.core = tile.covered = everything();
  LiuParameters p;
  p.max_radius = 1.0;
  const TileContours found = run(tile, p);
  EXPECT_TRUE(found.records.empty());
  EXPECT_TRUE(found.unproven.empty());
  EXPECT_EQ(found.isolated, 0U);
}

TEST(LiuMethod, OnePointAndItsDuplicates_AreIsolated) {
  TilePoints tile;
  tile.core = tile.covered = everything();
  tile.positions = {{7, 8, 9}};
  tile.ids = {3};
  tile.duplicates = {{5, 0}, {4, 0}};
  LiuParameters p;
  p.max_radius = 1.0;
  const TileContours found = run(tile, p);
  EXPECT_TRUE(found.records.empty());
  EXPECT_EQ(found.isolated, 3U);
}

TEST(LiuMethod, OppositeEndsOfTheLattice_AreNotNeighbours) {
  // Two clouds 2^32 steps apart must not see each other, whatever R_max.
  std::vector<LatticePoint> low = random_positions(Shape::kFold, 300, 1000.0, 5);
  std::vector<LatticePoint> both = low;
  for (LatticePoint& p : low) p = {p.x - 2147482000, p.y - 2147482000, p.z - 2147482000};
  both = low;
  for (const LatticePoint& p : low) both.push_back({-1 - p.x, -1 - p.y, -1 - p.z});
  LiuParameters p;
  p.max_radius = 1073741.824;  // 2^30 steps.
  p.radius_factor = 4.0;
  p.cf1_factor = 0.4;
  const TilePoints tile = tile_of(both, 1);
  const TileContours found = run(tile, p);
  const TileContours expected = reference_liu(tile, kMillimetres, p);
  EXPECT_FALSE(found.records.empty());
  EXPECT_EQ(found.records, expected.records);
  EXPECT_EQ(found.isolated, expected.isolated);
}

TEST(LiuMethod, SparsePointsOfHugeReach_EqualReference) {
  // Distances of millions of steps: beyond float, and beyond double for the sums.
  std::vector<LatticePoint> positions = random_positions(Shape::kFold, 60, 1.0e9, 11);
  LiuParameters p;
  p.max_radius = 1.0e6;
  p.k_min = 6;
  p.k_max = 10;
  p.radius_factor = 3.0;
  p.cf1_factor = 0.2;
  p.cf2 = 1.0;
  const TilePoints tile = tile_of(positions, 1);
  const TileContours found = run(tile, p);
  const TileContours expected = reference_liu(tile, kMillimetres, p);
  ASSERT_EQ(found.records.size(), expected.records.size());
  for (std::size_t i = 0; i < found.records.size(); ++i) {
    EXPECT_EQ(found.records[i].id, expected.records[i].id);
    EXPECT_EQ(found.records[i].classes, expected.records[i].classes);
    EXPECT_EQ(found.records[i].votes, expected.records[i].votes);
  }
}

TEST(LiuMethod, HugeBall_EqualsReference) {
  // A fixed radius in a dense cloud: every ball holds all points.
  LiuParameters p;
  p.max_radius = 10.0;
  p.radius = 5.0;
  p.cf1 = 0.05;
  p.cf2 = 1.0;
  const TilePoints tile = tile_of(random_positions(Shape::kFold, 700, 2000.0, 12), 1);
  const TileContours found = run(tile, p);
  EXPECT_FALSE(found.records.empty());
  EXPECT_EQ(found.records, reference_liu(tile, kMillimetres, p).records);
}

TEST(LiuMethod, DuplicatesOfContourPoints_HaveTheirRecord) {
  TilePoints tile = tile_of(random_positions(Shape::kGrid, 400, 2000.0, 1), 1);
  tile.duplicates.clear();
  for (std::uint32_t i = 0; i < tile.positions.size(); ++i) tile.duplicates.emplace_back(10000 + i, i);
  LiuParameters p;
  p.max_radius = 2.0;
  const TileContours found = run(tile, p);
  std::map<std::uint64_t, ContourRecord> of;
  for (const ContourRecord& record : found.records) of[record.id] = record;
  ASSERT_FALSE(of.empty());
  for (std::uint32_t i = 0; i < tile.positions.size(); ++i) {
    ASSERT_EQ(of.count(tile.ids[i]), of.count(10000 + i));
    if (!of.count(tile.ids[i])) continue;
    ContourRecord twin = of[10000 + i];
    twin.id = tile.ids[i];
    EXPECT_EQ(twin, of[tile.ids[i]]);
  }
}

TEST(LiuMethod, ReachBeyondTheLattice_IsRefused) {
  LiuParameters p;
  p.max_radius = 1.1e6;
  try {
    run(tile_of({{0, 0, 0}}, 1), p);
    FAIL() << "no exception";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("--max-radius"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace arris
