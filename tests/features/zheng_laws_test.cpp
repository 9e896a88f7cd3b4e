// The laws of extract_zheng: equal to the brute-force reference, and independent of everything but points, labels,
// table and parameters.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

#include "core/columns.h"
#include "core/error.h"
#include "core/parallel.h"
#include "features/zheng/zheng_method.h"
#include "random_clouds.h"
#include "supervoxel_scenes.h"
#include "tile_laws.h"
#include "zheng_reference.h"

namespace arris {
namespace {

using test::any;
using test::everything;
using test::expect_equal;
using test::Shape;
using test::tile_of;

const Lattice kMillimetres{0.001, {0.0, 0.0, 0.0}};

struct Cloud {
  TilePoints tile;
  std::map<std::uint64_t, std::uint32_t> label_of;  ///< By id.
  SupervoxelTable table;
  ZhengParameters parameters;
  std::uint64_t seed = 0;

  std::vector<std::uint32_t> labels(const TilePoints& part) const {
    std::vector<std::uint32_t> labels;
    for (const std::uint64_t id : part.ids) labels.push_back(label_of.at(id));
    return labels;
  }
  TileContours run(const TilePoints& part) const {
    return extract_zheng(part, labels(part), table, kMillimetres, parameters);
  }
};

/// A cloud of about `points` points, cut into cubes; a few points have no supervoxel.
Cloud any_cloud(std::size_t points) {
  Cloud cloud;
  const auto shape = static_cast<Shape>(any(0, static_cast<int>(Shape::kLast) + 1));
  RC_CLASSIFY(true, test::name(shape));
  cloud.seed = *rc::gen::arbitrary<std::uint64_t>();
  const double extent = *rc::gen::element(60.0, 1000.0, 30000.0);
  cloud.tile = tile_of(test::random_positions(shape, points, extent, cloud.seed), cloud.seed);
  const double spacing = extent / std::sqrt(static_cast<double>(points));
  const auto voxel = static_cast<std::int32_t>(std::max(2.0 * spacing, 1.0));
  test::Supervoxels made = test::cubic_supervoxels(cloud.tile.positions, any(2, 7) * voxel, voxel);
  for (std::uint32_t& label : made.labels) label = any(0, 40) == 0 ? 0 : label;
  cloud.table = test::table_of(cloud.tile.positions, made.labels, voxel);
  for (std::size_t i = 0; i < made.labels.size(); ++i) cloud.label_of[cloud.tile.ids[i]] = made.labels[i];
  ZhengParameters& p = cloud.parameters;
  p.spacing = 0.001 * spacing * *rc::gen::element(1.0, 1.0, 0.3, 4.0);
  p.angle_deg = *rc::gen::element(5.0, 25.0, 60.0);
  p.contact_factor = *rc::gen::element(1.0, 3.0);
  p.alpha_factor = *rc::gen::element(0.8, 2.0, 4.0);
  p.seam_factor = *rc::gen::element(0.5, 1.8);
  p.improved = *rc::gen::arbitrary<bool>();
  return cloud;
}

RC_GTEST_PROP(ZhengMethod, AnyCloudReadLiterally_EqualsReference, ()) {
  Cloud cloud = any_cloud(any<std::size_t>(1, 500));
  cloud.parameters.improved = false;
  expect_equal(cloud.run(cloud.tile), test::reference_zheng(cloud.tile, cloud.labels(cloud.tile), cloud.table,
                                                            kMillimetres, cloud.parameters));
}

RC_GTEST_PROP(ZhengMethod, OrderOfEntries_ChangesNothing, ()) {
  const Cloud cloud = any_cloud(600);
  expect_equal(cloud.run(cloud.tile), cloud.run(test::reordered(cloud.tile, cloud.seed)));
}

RC_GTEST_PROP(ZhengMethod, Translation_ChangesNothing, ()) {
  Cloud cloud = any_cloud(500);
  const TileContours before = cloud.run(cloud.tile);
  const LatticePoint from = cloud.tile.positions[0];
  cloud.tile.positions = test::anywhere(cloud.tile.positions);
  for (std::size_t label = 1; label < cloud.table.size(); ++label) {
    for (int axis = 0; axis < 3; ++axis) {
      cloud.table.centroid[label][static_cast<std::size_t>(axis)] +=
          static_cast<double>(std::int64_t{cloud.tile.positions[0][axis]} - from[axis]);
    }
  }
  expect_equal(before, cloud.run(cloud.tile));
}

RC_GTEST_PROP(ZhengMethod, TilesWithTheHalo_MakeTheWhole, ()) {
  const Cloud cloud = any_cloud(800);
  LatticeBox bounds;
  for (const LatticePoint& p : cloud.tile.positions) bounds.include(p);
  const std::int64_t cut = any(bounds.min[0], bounds.max[0] + 1);
  const auto halo = static_cast<std::int64_t>(std::ceil(zheng_halo(cloud.parameters) / kMillimetres.step));
  std::map<std::uint64_t, ContourRecord> merged;
  for (const bool upper : {false, true}) {
    LatticeBox core = everything();
    (upper ? core.min : core.max)[0] = cut;
    const TileContours part = cloud.run(test::part_of(cloud.tile, core, halo));
    RC_ASSERT(part.unproven.empty());
    test::merge(merged, part.records);
  }
  TileContours split;
  for (const auto& [id, record] : merged) split.records.push_back(record);
  expect_equal(split, cloud.run(cloud.tile));
}

RC_GTEST_PROP(ZhengMethod, Duplicates_HaveTheRecordOfTheirPosition, ()) {
  Cloud cloud = any_cloud(300);
  cloud.tile.duplicates.clear();
  const TileContours once = cloud.run(cloud.tile);
  for (std::uint32_t i = 0; i < cloud.tile.positions.size(); ++i) {
    cloud.tile.duplicates.emplace_back(cloud.tile.ids[i] + 1000000, i);
  }
  TileContours expected = once;
  for (ContourRecord record : once.records) {
    record.id += 1000000;
    expected.records.push_back(record);
  }
  expect_equal(expected, cloud.run(cloud.tile));
}

TEST(ZhengMethod, NumberOfThreads_ChangesNothing) {
  const TilePoints tile = tile_of(test::random_positions(Shape::kGridFold, 20000, 4000.0, 3), 3);
  const test::Supervoxels made = test::cubic_supervoxels(tile.positions, 500, 56);
  ZhengParameters p;
  p.spacing = 0.028;
  for (const bool improved : {false, true}) {
    p.improved = improved;
    ContourRecords records[2];
    int index = 0;
    for (const int threads : {1, 4}) {
      const ThreadLimit limit(threads);
      records[index++] = extract_zheng(tile, made.labels, made.table, kMillimetres, p).records;
    }
    ASSERT_FALSE(records[0].empty());
    EXPECT_EQ(records[0], records[1]);
  }
}

TEST(ZhengMethod, PointsWithoutSupervoxels_HaveNoContours) {
  const TilePoints tile = tile_of(test::random_positions(Shape::kPlane, 400, 1000.0, 1), 1);
  ZhengParameters p;
  p.spacing = 0.05;
  const std::vector<std::uint32_t> labels(tile.positions.size(), 0);
  for (const bool improved : {false, true}) {
    p.improved = improved;
    EXPECT_TRUE(
        extract_zheng(tile, labels, test::table_of(tile.positions, labels, 100), kMillimetres, p).records.empty());
  }
}

TEST(ZhengMethod, EmptyTile_FindsNothing) {
  TilePoints tile;
  tile.core = tile.covered = everything();
  ZhengParameters p;
  p.spacing = 1.0;
  EXPECT_TRUE(extract_zheng(tile, {}, test::table_of({}, {}, 100), kMillimetres, p).records.empty());
}

TEST(ZhengMethod, TwoWallsOfOneSupervoxelEach_MeetInContactsOfARightAngle) {
  // Exact grids of 1 m pitch in the planes z = 0 and x = 0, half a pitch away from their line.
  std::vector<LatticePoint> positions;
  std::vector<std::uint32_t> labels;
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) {
      positions.push_back({500 + 1000 * i, 1000 * j, 0});
      labels.push_back(1);
      positions.push_back({0, 1000 * j, 500 + 1000 * i});
      labels.push_back(2);
    }
  }
  TilePoints tile;
  tile.core = tile.covered = everything();
  tile.positions.assign(positions.begin(), positions.end());
  for (std::size_t i = 0; i < positions.size(); ++i) tile.ids.push_back(i);
  ZhengParameters p;
  p.spacing = 1.0;
  p.boundary = false;
  const auto records = extract_zheng(tile, labels, test::table_of(positions, labels, 2000), kMillimetres, p).records;
  ASSERT_EQ(records.size(), 20U);
  for (const ContourRecord& record : records) {
    EXPECT_EQ(record.classes, kSupervoxelContact | kFold);
    EXPECT_EQ(std::max(positions[record.id].x, positions[record.id].z), 500);
    EXPECT_NEAR(record.fold_angle_deg, 90.0, 1e-4);
    EXPECT_NEAR(record.score, 1.0 - std::sqrt(0.5) / 3.0, 1e-6);
  }
}

TEST(ZhengMethod, OneSquareGrid_HasItsOutlineAsBorder) {
  std::vector<LatticePoint> positions;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) positions.push_back({1000 * i, 1000 * j, 0});
  }
  const TilePoints tile = tile_of(positions, 1);
  const std::vector<std::uint32_t> labels(positions.size(), 1);
  ZhengParameters p;
  p.spacing = 1.0;
  const auto records = extract_zheng(tile, labels, test::table_of(positions, labels, 2000), kMillimetres, p).records;
  EXPECT_EQ(records.size(), 44U);
  for (const ContourRecord& record : records) EXPECT_EQ(record.classes, kBoundary);
}

TEST(ZhengParameters, ValuesOutOfRange_AreRefusedByName) {
  const auto message = [](auto change) -> std::string {
    ZhengParameters p;
    p.spacing = 1.0;
    change(p);
    try {
      validate(p);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([](ZhengParameters&) {}), "");
  EXPECT_NE(message([](ZhengParameters& p) { p.spacing = 0.0; }).find("--spacing"), std::string::npos);
  EXPECT_NE(message([](ZhengParameters& p) { p.angle_deg = 90.0; }).find("--plane-angle"), std::string::npos);
  EXPECT_NE(message([](ZhengParameters& p) { p.contact_cap = -1.0; }).find("--contact-cap"), std::string::npos);
  EXPECT_NE(message([](ZhengParameters& p) { p.alpha = std::nan(""); }).find("--alpha"), std::string::npos);
  EXPECT_NE(message([](ZhengParameters& p) { p.seam_factor = 0.0; }).find("--seam-factor"), std::string::npos);
}

TEST(ZhengMethod, ReachBeyondTheLattice_IsRefused) {
  ZhengParameters p;
  p.spacing = 1e5;
  const TilePoints tile = tile_of({{0, 0, 0}}, 1);
  const std::vector<std::uint32_t> labels{1};
  EXPECT_THROW(extract_zheng(tile, labels, test::table_of(tile.positions, labels, 2), kMillimetres, p), ConfigError);
}

}  // namespace
}  // namespace arris
