// The laws of extract_arris: results depend on the points and the parameters and on nothing else.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/columns.h"
#include "core/error.h"
#include "core/parallel.h"
#include "features/arris/arris_method.h"
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
using test::reordered;
using test::Shape;
using test::tile_of;

const Lattice kMillimetres{0.001, {0.0, 0.0, 0.0}};

struct Cloud {
  std::vector<LatticePoint> positions;
  ArrisParameters parameters;
  std::uint64_t seed;
};

Cloud any_cloud(std::size_t points) {
  Cloud cloud;
  const auto shape = static_cast<Shape>(any(0, static_cast<int>(Shape::kLast) + 1));
  cloud.seed = *rc::gen::arbitrary<std::uint64_t>();
  const double extent = *rc::gen::element(40.0, 1000.0, 30000.0);
  cloud.positions = random_positions(shape, points, extent, cloud.seed);
  if (*rc::gen::arbitrary<bool>()) {  // Noise: wide balls.
    std::mt19937_64 random(cloud.seed);
    const auto most = static_cast<std::uint64_t>(extent / std::sqrt(static_cast<double>(points))) + 1;
    for (LatticePoint& p : cloud.positions) p.z += static_cast<std::int32_t>(random() % (2 * most));
  }
  ArrisParameters& p = cloud.parameters;
  p.max_radius = extent * 0.001 * *rc::gen::element(0.12, 0.4, 5.0);
  p.spacing = *rc::gen::element(0.0, 0.0, 0.8) * extent * 0.001 / std::sqrt(static_cast<double>(points));
  p.fold = *rc::gen::element(true, true, false);
  p.boundary = *rc::gen::element(true, true, false);
  RC_CLASSIFY(true, test::name(shape));
  return cloud;
}

TileContours run(const TilePoints& tile, const ArrisParameters& p) {
  return extract_arris(tile, kMillimetres, p);
}

ArrisParameters with_reach(double max_radius) {
  ArrisParameters p;
  p.max_radius = max_radius;
  return p;
}

RC_GTEST_PROP(ArrisMethod, OrderOfEntries_ChangesNothing, ()) {
  const Cloud cloud = any_cloud(600);
  const TilePoints tile = tile_of(cloud.positions, cloud.seed);
  const TileContours found = run(tile, cloud.parameters);
  RC_ASSERT(found.unproven.empty());
  expect_equal(found, run(reordered(tile, cloud.seed), cloud.parameters));
}

RC_GTEST_PROP(ArrisMethod, Translation_ChangesNothing, ()) {
  const Cloud cloud = any_cloud(500);
  expect_equal(run(tile_of(cloud.positions, cloud.seed), cloud.parameters),
               run(tile_of(anywhere(cloud.positions), cloud.seed), cloud.parameters));
}

RC_GTEST_PROP(ArrisMethod, SplitIntoTiles_MergesToTheWhole, ()) {
  const Cloud cloud = any_cloud(600);
  const TilePoints whole = tile_of(cloud.positions, cloud.seed);
  LatticeBox bounds;
  for (const LatticePoint& p : whole.positions) bounds.include(p);
  std::int64_t cut[2];
  for (int axis = 0; axis < 2; ++axis) cut[axis] = any(bounds.min[axis], bounds.max[axis] + 1);
  const double extent = static_cast<double>(bounds.max[0] - bounds.min[0]);
  const auto halo = static_cast<std::int64_t>(extent * *rc::gen::element(0.0, 0.02, 0.2, 0.5));
  std::map<std::uint64_t, ContourRecord> merged;
  std::size_t records = 0;
  TileContours split;
  for (int tile = 0; tile < 4; ++tile) {
    LatticeBox core = everything();
    for (int axis = 0; axis < 2; ++axis) (tile >> axis & 1 ? core.min : core.max)[axis] = cut[axis];
    const TileContours part = run(part_of(whole, core, halo), cloud.parameters);
    merge(merged, part.records);
    records += part.records.size();
    split.isolated += part.isolated;
    for (const UnprovenQuery& query : part.unproven) {
      RC_ASSERT(query.reach_steps <= static_cast<std::int64_t>(std::ceil(cloud.parameters.max_radius * 1000.0)) + 1);
      const TileContours again = run(part_of(whole, query), cloud.parameters);
      RC_ASSERT(again.unproven.empty());
      merge(merged, again.records);
      records += again.records.size();
      split.isolated += again.isolated;
    }
  }
  RC_ASSERT(records == merged.size());  // Every point is judged once.
  for (const auto& [id, record] : merged) split.records.push_back(record);
  expect_equal(split, run(whole, cloud.parameters));
}

RC_GTEST_PROP(ArrisMethod, QueriesInTwoParts_MergeToTheWhole, ()) {
  const Cloud cloud = any_cloud(500);
  const TilePoints tile = tile_of(cloud.positions, cloud.seed);
  std::vector<std::uint32_t> parts[2];
  for (std::uint32_t i = 0; i < tile.positions.size(); ++i) parts[any(0, 2)].push_back(i);
  std::map<std::uint64_t, ContourRecord> merged;
  TileContours both;
  for (const auto& part : parts) {
    const TileContours found = extract_arris(tile, kMillimetres, cloud.parameters, part);
    merge(merged, found.records);
    both.isolated += found.isolated;
  }
  for (const auto& [id, record] : merged) both.records.push_back(record);
  expect_equal(both, run(tile, cloud.parameters));
}

RC_GTEST_PROP(ArrisMethod, Records_AreSane, ()) {
  const Cloud cloud = any_cloud(700);
  const TileContours found = run(tile_of(cloud.positions, cloud.seed), cloud.parameters);
  std::uint64_t last = 0;
  for (const ContourRecord& r : found.records) {
    RC_ASSERT(r.id > last);
    last = r.id;
    RC_ASSERT(r.classes != 0);
    RC_ASSERT(r.score >= static_cast<float>(cloud.parameters.min_score));
    RC_ASSERT(r.score <= 1.0F);
    if (r.classes & kFold) RC_ASSERT(cloud.parameters.fold);
    if (r.classes & kBoundary) RC_ASSERT(cloud.parameters.boundary);
    if (r.classes & kFold) RC_ASSERT(r.fold_angle_deg > 0.0F && r.fold_angle_deg < 180.0F);
    if (r.classes & kBoundary) RC_ASSERT(r.gap_deg > 0.0F && r.gap_deg <= 360.0F);
    for (const float c : r.to_edge) RC_ASSERT(std::isfinite(c));
  }
}

TEST(ArrisMethod, NumberOfThreads_ChangesNothing) {
  for (const Shape shape : {Shape::kFold, Shape::kGridFold, Shape::kDensityStep}) {
    const TilePoints tile = tile_of(random_positions(shape, 10000, 4000.0, 3), 3);
    ContourRecords records[2];
    int index = 0;
    for (const int threads : {1, 4}) {
      const ThreadLimit limit(threads);
      records[index++] = run(tile, with_reach(2.0)).records;
    }
    ASSERT_FALSE(records[0].empty());
    EXPECT_EQ(records[0], records[1]) << name(shape);
  }
}

TEST(ArrisMethod, HigherPrecision_OnlyDropsPoints) {
  const TilePoints tile = tile_of(random_positions(Shape::kFold, 3000, 3000.0, 8), 8);
  std::map<std::uint64_t, ContourRecord> all;
  ArrisParameters p = with_reach(3.0);
  p.min_score = 0.0;
  merge(all, run(tile, p).records);
  ASSERT_FALSE(all.empty());
  for (const double least : {0.3, 0.7, 0.95}) {
    p.min_score = least;
    const ContourRecords kept = run(tile, p).records;
    std::size_t expected = 0;
    for (const auto& [id, record] : all) expected += record.score >= least;
    EXPECT_NEAR(static_cast<double>(kept.size()), static_cast<double>(expected), 1.0) << "scores are rounded to float";
    for (const ContourRecord& r : kept) EXPECT_EQ(r, all.at(r.id));
  }
}

TEST(ArrisMethod, EmptyTile_FindsNothing) {
  TilePoints tile;
  tile.core = tile.covered = everything();
  const TileContours found = run(tile, with_reach(1.0));
  EXPECT_TRUE(found.records.empty());
  EXPECT_TRUE(found.unproven.empty());
  EXPECT_EQ(found.isolated, 0U);
}

TEST(ArrisMethod, FewerNeighboursThanTwenty_AreIsolated) {
  for (const std::size_t points : {1U, 19U, 20U}) {
    std::vector<LatticePoint> positions = random_positions(Shape::kVolume, points, 1000.0, 4);
    const TilePoints tile = tile_of(positions, 4);
    const TileContours found = run(tile, with_reach(100.0));
    EXPECT_TRUE(found.records.empty());
    EXPECT_TRUE(found.unproven.empty());
    EXPECT_EQ(found.isolated, positions.size()) << "duplicates count";
  }
}

TEST(ArrisMethod, AllPointsAtOnePosition_AreIsolated) {
  const TileContours found = run(tile_of(std::vector<LatticePoint>(1000, {5, -6, 7}), 1), with_reach(1.0));
  EXPECT_TRUE(found.records.empty());
  EXPECT_EQ(found.isolated, 1000U);
}

TEST(ArrisMethod, CollinearPoints_AreNoSurfaceAndHaveNoContour) {
  for (const LatticePoint step : {LatticePoint{1, 0, 0}, LatticePoint{3, -7, 11}}) {
    std::vector<LatticePoint> positions;
    for (int i = -400; i < 400; ++i) positions.push_back({i * step.x, i * step.y, i * step.z});
    const TileContours found = run(tile_of(positions, 1), with_reach(10.0));
    EXPECT_TRUE(found.records.empty());
    EXPECT_EQ(found.isolated, 0U);
  }
}

TEST(ArrisMethod, OppositeEndsOfTheLattice_AreNotNeighbours) {
  // A fold at either end of int32, 2^32 steps apart: each must find what it finds alone in the middle.
  const std::vector<LatticePoint> middle = random_positions(Shape::kFold, 900, 1000.0, 5);
  std::vector<LatticePoint> both;
  for (const LatticePoint& p : middle) both.push_back({p.x - 2147480000, p.y - 2147480000, p.z - 2147480000});
  for (const LatticePoint& p : middle) both.push_back({p.x + 2147480000, p.y + 2147480000, p.z + 2147480000});
  const TileContours alone = run(tile_of(middle, 1), with_reach(1073741.824));
  const TileContours found = run(tile_of(both, 1), with_reach(1073741.824));  // 2^30 steps.
  ASSERT_FALSE(alone.records.empty());
  EXPECT_EQ(found.records.size(), 2 * alone.records.size());
}

TEST(ArrisMethod, SparsePointsOfHugeReach_FindTheSameAsSmallOnes) {
  // The same shape, a million times larger: beyond float, and beyond double for sums.
  const std::vector<LatticePoint> small = random_positions(Shape::kFold, 900, 1500.0, 11);
  std::vector<LatticePoint> large;
  for (const LatticePoint& p : small) large.push_back({p.x * 700000, p.y * 700000, p.z * 700000});
  const TileContours near = run(tile_of(small, 1), with_reach(1.0));
  const TileContours far = run(tile_of(large, 1), with_reach(700000.0));
  ASSERT_FALSE(near.records.empty());
  ASSERT_EQ(near.records.size(), far.records.size());
  for (std::size_t i = 0; i < near.records.size(); ++i) {
    EXPECT_EQ(near.records[i].id, far.records[i].id);
    EXPECT_EQ(near.records[i].classes, far.records[i].classes);
    EXPECT_NEAR(near.records[i].fold_angle_deg, far.records[i].fold_angle_deg, 0.01);
  }
}

TEST(ArrisMethod, EnormousClusterBesideSparsePoints_LeavesThePlatesBorder) {
  // 20 000 points in a cube of 32 steps, a plate of spacing 1000 around it: balls of the plate hold the whole cluster.
  std::vector<LatticePoint> positions;
  for (int i = 0; i < 20000; ++i) positions.push_back({i % 32, i / 32 % 32, i / 1024});
  for (int x = -15; x <= 15; ++x) {
    for (int y = -15; y <= 15; ++y) {
      if (x != 0 || y != 0) positions.push_back({1000 * x, 1000 * y, 0});
    }
  }
  const TilePoints tile = tile_of(positions, 1);
  const TileContours found = run(tile, with_reach(20.0));
  std::map<std::uint64_t, LatticePoint> at;
  for (std::size_t i = 0; i < tile.ids.size(); ++i) at[tile.ids[i]] = tile.positions[i];
  std::size_t borders = 0;
  for (const ContourRecord& r : found.records) {
    const LatticePoint& p = at.at(r.id);
    borders += std::abs(p.x) == 15000 || std::abs(p.y) == 15000;
  }
  EXPECT_EQ(borders, 120U) << "the plate's own border is found";
}

TEST(ArrisMethod, DuplicatesOfContourPoints_HaveTheirRecord) {
  TilePoints tile = tile_of(random_positions(Shape::kGrid, 900, 3000.0, 1), 1);
  tile.duplicates.clear();
  for (std::uint32_t i = 0; i < tile.positions.size(); ++i) tile.duplicates.emplace_back(10000 + i, i);
  const TileContours found = run(tile, with_reach(3.0));
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

TEST(ArrisMethod, Duplicates_ChangeNoOtherRecord) {
  TilePoints tile = tile_of(random_positions(Shape::kFold, 1500, 3000.0, 2), 2);
  tile.duplicates.clear();
  const TileContours without = run(tile, with_reach(3.0));
  for (std::uint32_t i = 0; i < tile.positions.size(); i += 3) tile.duplicates.emplace_back(100000 + i, i);
  TileContours with = run(tile, with_reach(3.0));
  std::erase_if(with.records, [](const ContourRecord& r) { return r.id >= 100000; });
  ASSERT_FALSE(without.records.empty());
  EXPECT_EQ(with.records, without.records);
}

TEST(ArrisMethod, ParametersOutOfRange_AreRefused) {
  const TilePoints tile = tile_of({{0, 0, 0}}, 1);
  const auto message = [&](const ArrisParameters& p) -> std::string {
    try {
      run(tile, p);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no exception";
  };
  EXPECT_NE(message(with_reach(1.1e6)).find("--max-radius"), std::string::npos);
  EXPECT_NE(message(with_reach(0.0)).find("--max-radius"), std::string::npos);
  EXPECT_NE(message(with_reach(std::nan(""))).find("--max-radius"), std::string::npos);
  ArrisParameters p = with_reach(1.0);
  p.min_score = 1.5;
  EXPECT_NE(message(p).find("--precision"), std::string::npos);
  p = with_reach(1.0);
  p.spacing = -1.0;
  EXPECT_NE(message(p).find("--spacing"), std::string::npos);
}

}  // namespace
}  // namespace arris
