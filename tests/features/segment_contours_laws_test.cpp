// The laws of analyse_segment_contours: edges equal to those among all points, and independence of everything but
// points, labels, planes and parameters.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

#include "core/columns.h"
#include "core/error.h"
#include "core/parallel.h"
#include "features/planar/alpha_edges.h"
#include "features/planar/plane_frame.h"
#include "features/segment_contours/segment_contours.h"
#include "random_clouds.h"
#include "segment_testing.h"
#include "supervoxel_scenes.h"
#include "tile_laws.h"

namespace arris {

void PrintTo(const OutlineEdge& e, std::ostream* out) {
  *out << "{segment " << e.segment << " from " << e.from << " to " << e.to << "}";
}

namespace {

using test::any;
using test::everything;
using test::Shape;
using test::tile_of;

const Lattice kMillimetres{0.001, {0.0, 0.0, 0.0}};

struct Cloud {
  TilePoints tile;
  std::map<std::uint64_t, std::uint32_t> label_of;  ///< By id.
  std::vector<SegmentPlane> planes;
  SegmentContourParameters parameters;
  std::uint64_t seed = 0;

  std::vector<std::uint32_t> labels(const TilePoints& part) const {
    std::vector<std::uint32_t> labels;
    for (const std::uint64_t id : part.ids) labels.push_back(label_of.at(id));
    return labels;
  }
  SegmentContours run(const TilePoints& part) const {
    return analyse_segment_contours(part, labels(part), planes, kMillimetres, parameters);
  }
  std::int64_t halo() const {
    return static_cast<std::int64_t>(
        std::ceil(segment_contour_halo(parameters, planes, kMillimetres) / kMillimetres.step));
  }
};

/// A cloud of about `points` points, cut into cubes; a few points have no segment.
Cloud any_cloud(std::size_t points) {
  Cloud cloud;
  const auto shape = static_cast<Shape>(any(0, static_cast<int>(Shape::kLast) + 1));
  RC_CLASSIFY(true, test::name(shape));
  cloud.seed = *rc::gen::arbitrary<std::uint64_t>();
  const double extent = *rc::gen::element(60.0, 1000.0, 30000.0);
  cloud.tile = tile_of(test::random_positions(shape, points, extent, cloud.seed), cloud.seed);
  const double spacing = extent / std::sqrt(static_cast<double>(points));
  const auto voxel = static_cast<std::int32_t>(std::max(2.0 * spacing, 1.0));
  test::Supervoxels made = test::cubic_supervoxels(cloud.tile.positions, any(3, 12) * voxel, voxel);
  for (std::uint32_t& label : made.labels) label = any(0, 40) == 0 ? 0 : label;
  cloud.planes = test::planes_of(cloud.tile.positions, made.labels, spacing * *rc::gen::element(1.0, 1.0, 0.4, 2.0));
  for (SegmentPlane& plane : cloud.planes) plane.spacing *= *rc::gen::element(1.0, 1.0, 1.7);
  for (std::size_t i = 0; i < made.labels.size(); ++i) cloud.label_of[cloud.tile.ids[i]] = made.labels[i];
  SegmentContourParameters& p = cloud.parameters;
  p.alpha_factor = *rc::gen::element(1.0, 2.0, 2.5);
  p.fold_angle_deg = *rc::gen::element(5.0, 15.0, 40.0);
  p.most_spacing = *rc::gen::element(0.0, 0.0012 * spacing);
  return cloud;
}

void expect_same(const SegmentContours& a, const SegmentContours& b) {
  TileContours records[2];
  records[0].records = a.records;
  records[1].records = b.records;
  test::expect_equal(records[0], records[1]);
  RC_CLASSIFY(!a.edges.empty(), "has edges");
  RC_ASSERT(a.edges == b.edges);
}

/// Among all points of the segment in its slab, at any distance.
std::vector<OutlineEdge> reference_edges(const Cloud& cloud) {
  std::vector<OutlineEdge> edges;
  AlphaEdges alpha_edges;
  const TilePoints& tile = cloud.tile;
  for (std::uint32_t label = 1; label <= cloud.planes.size(); ++label) {
    const SegmentPlane& plane = cloud.planes[label - 1];
    const SegmentLengths lengths = segment_lengths(plane, kMillimetres, cloud.parameters);
    const PlaneFrame frame = plane_frame(plane.normal);
    std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> at;  // Places in the plane, smallest id first.
    for (std::uint32_t i = 0; i < tile.positions.size(); ++i) {
      const LatticePoint& p = tile.positions[i];
      if (cloud.label_of.at(tile.ids[i]) != label || std::fabs(signed_distance(plane, p)) > lengths.slab) continue;
      const Vector3 position{double(p.x), double(p.y), double(p.z)};
      const auto place = std::make_pair(frame_units(dot(frame.u, position)), frame_units(dot(frame.v, position)));
      const auto [found, fresh] = at.try_emplace(place, i);
      if (!fresh && tile.ids[i] < tile.ids[found->second]) found->second = i;
    }
    for (const auto& [p, from] : at) {
      std::vector<PlanarNeighbour> around;
      for (const auto& [q, to] : at) {
        if (q != p) around.push_back({q.first - p.first, q.second - p.second, to});
      }
      for (const PlanarNeighbour& q : alpha_edges.leaving(around, frame_units(lengths.two_alpha))) {
        edges.push_back({label, tile.ids[from], tile.ids[q.index], tile.positions[from], tile.positions[q.index]});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

RC_GTEST_PROP(SegmentContours, EdgesOfAnyCloud_EqualThoseAmongAllPoints, ()) {
  const Cloud cloud = any_cloud(any<std::size_t>(1, 400));
  const std::vector<OutlineEdge> expected = reference_edges(cloud);
  RC_CLASSIFY(!expected.empty(), "has edges");
  RC_ASSERT(cloud.run(cloud.tile).edges == expected);
}

RC_GTEST_PROP(SegmentContours, OrderOfEntries_ChangesNothing, ()) {
  const Cloud cloud = any_cloud(600);
  expect_same(cloud.run(cloud.tile), cloud.run(test::reordered(cloud.tile, cloud.seed)));
}

RC_GTEST_PROP(SegmentContours, TilesWithTheHalo_MakeTheWhole, ()) {
  const Cloud cloud = any_cloud(800);
  LatticeBox bounds;
  for (const LatticePoint& p : cloud.tile.positions) bounds.include(p);
  const int axis = any(0, 3);
  const std::int64_t cut = any(bounds.min[axis], bounds.max[axis] + 1);
  std::map<std::uint64_t, ContourRecord> merged;
  SegmentContours split;
  for (const bool upper : {false, true}) {
    LatticeBox core = everything();
    (upper ? core.min : core.max)[axis] = cut;
    const SegmentContours part = cloud.run(test::part_of(cloud.tile, core, cloud.halo()));
    test::merge(merged, part.records);
    split.edges.insert(split.edges.end(), part.edges.begin(), part.edges.end());
  }
  for (const auto& [id, record] : merged) split.records.push_back(record);
  std::sort(split.edges.begin(), split.edges.end());
  expect_same(split, cloud.run(cloud.tile));
}

RC_GTEST_PROP(SegmentContours, Duplicates_HaveTheRecordOfTheirPosition, ()) {
  Cloud cloud = any_cloud(300);
  cloud.tile.duplicates.clear();
  const SegmentContours once = cloud.run(cloud.tile);
  for (std::uint32_t i = 0; i < cloud.tile.positions.size(); ++i) {
    cloud.tile.duplicates.emplace_back(cloud.tile.ids[i] + 1000000, i);
  }
  SegmentContours expected = once;
  for (ContourRecord record : once.records) {
    record.id += 1000000;
    expected.records.push_back(record);
  }
  expect_same(expected, cloud.run(cloud.tile));
}

RC_GTEST_PROP(SegmentContours, NoBoundariesOrNoFolds_LeaveTheOthersAlone, ()) {
  Cloud cloud = any_cloud(500);
  const ContourRecords all = cloud.run(cloud.tile).records;
  const auto of_class = [&](std::uint8_t bit) {
    ContourRecords records;
    for (const ContourRecord& record : all) {
      if (record.classes & bit) records.push_back(record);
    }
    return records;
  };
  cloud.parameters.outlines = false;
  cloud.parameters.boundary = false;
  const SegmentContours folds = cloud.run(cloud.tile);
  RC_ASSERT(folds.records == of_class(kFold));
  RC_ASSERT(folds.edges.empty());
  cloud.parameters.boundary = true;
  cloud.parameters.fold = false;
  RC_ASSERT(cloud.run(cloud.tile).records == of_class(kBoundary));
}

TEST(SegmentContours, NumberOfThreads_ChangesNothing) {
  const TilePoints tile = tile_of(test::random_positions(Shape::kGridFold, 20000, 4000.0, 3), 3);
  const test::Supervoxels made = test::cubic_supervoxels(tile.positions, 500, 56);
  const std::vector<SegmentPlane> planes = test::planes_of(tile.positions, made.labels, 28.0);
  SegmentContours found[2];
  int index = 0;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    found[index++] = analyse_segment_contours(tile, made.labels, planes, kMillimetres, {});
  }
  ASSERT_FALSE(found[0].records.empty());
  EXPECT_EQ(found[0].records, found[1].records);
  EXPECT_EQ(found[0].edges, found[1].edges);
}

TEST(SegmentContours, PlanesWithoutSpacing_GiveFiniteNumbers) {
  const TilePoints tile = tile_of(test::random_positions(Shape::kGridFold, 400, 400.0, 3), 3);
  const test::Supervoxels made = test::cubic_supervoxels(tile.positions, 200, 40);
  const std::vector<SegmentPlane> planes = test::planes_of(tile.positions, made.labels, 0.0);
  for (const ContourRecord& record : analyse_segment_contours(tile, made.labels, planes, kMillimetres, {}).records) {
    EXPECT_TRUE(record.score >= 0.0F && record.score <= 1.0F);
    EXPECT_TRUE(std::isfinite(record.gap_deg) && std::isfinite(record.fold_angle_deg));
  }
}

TEST(SegmentContours, EmptyTile_FindsNothing) {
  TilePoints tile;
  tile.core = tile.covered = everything();
  const SegmentContours contours = analyse_segment_contours(tile, {}, {}, kMillimetres, {});
  EXPECT_TRUE(contours.records.empty());
  EXPECT_TRUE(contours.edges.empty());
}

TEST(SegmentContourParameters, ValuesOutOfRange_AreRefusedByName) {
  const auto message = [](auto change) -> std::string {
    SegmentContourParameters p;
    change(p);
    try {
      validate(p);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([](SegmentContourParameters&) {}), "");
  EXPECT_NE(message([](auto& p) { p.alpha_factor = 0.9; }).find("--alpha-factor"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.fold_angle_deg = 90.0; }).find("--fold-angle"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.most_spacing = std::nan(""); }).find("most_spacing"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.viewpoint[1] = INFINITY; }).find("viewpoint"), std::string::npos);
}

TEST(SegmentContourParameters, ReachBeyondTheLattice_IsRefused) {
  SegmentPlane plane;
  plane.spacing = 2e7;
  const std::vector<SegmentPlane> planes{plane};
  EXPECT_THROW(segment_contour_halo({}, planes, kMillimetres), ConfigError);
  SegmentContourParameters bounded;
  bounded.most_spacing = 1.0;
  EXPECT_LE(segment_contour_halo(bounded, planes, kMillimetres), 6.01);
}

}  // namespace
}  // namespace arris
