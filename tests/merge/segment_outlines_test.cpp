// From labelled points to polygons: tiles with halos, whole outlines.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "contour_scenes.h"
#include "features/segment_contours/segment_contours.h"
#include "merge/outline_plane.h"
#include "merge/outline_rings.h"
#include "merge/outline_validity.h"
#include "random_clouds.h"
#include "segment_testing.h"
#include "supervoxel_scenes.h"
#include "tile_laws.h"

namespace arris::merge {
namespace {

using test::any;
using test::Shape;

const Lattice kMillimetres{0.001, {0.0, 0.0, 0.0}};

std::size_t edges_in(const std::vector<SegmentOutline>& outlines) {
  std::size_t edges = 0;
  for (const SegmentOutline& outline : outlines) {
    for (const OutlinePolygon& polygon : outline.polygons) {
      edges += polygon.outer.size();
      for (const OutlineRing& hole : polygon.holes) edges += hole.size();
    }
  }
  return edges;
}

RC_GTEST_PROP(SegmentOutlines, AnyCloudInTiles_UsesAllEdgesInValidPolygons, ()) {
  const auto shape = static_cast<Shape>(any(0, static_cast<int>(Shape::kLast) + 1));
  RC_CLASSIFY(true, test::name(shape));
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const double extent = *rc::gen::element(60.0, 1000.0, 30000.0);
  const TilePoints tile = test::tile_of(test::random_positions(shape, 800, extent, seed), seed);
  const double spacing = extent / std::sqrt(800.0);
  const auto voxel = static_cast<std::int32_t>(std::max(2.0 * spacing, 1.0));
  const std::vector<std::uint32_t> labels = test::cubic_supervoxels(tile.positions, any(3, 15) * voxel, voxel).labels;
  const std::vector<SegmentPlane> planes =
      test::planes_of(tile.positions, labels, spacing * *rc::gen::element(0.7, 1.0));
  std::map<std::uint64_t, std::uint32_t> label_of;
  for (std::size_t i = 0; i < labels.size(); ++i) label_of[tile.ids[i]] = labels[i];
  const std::int64_t halo =
      static_cast<std::int64_t>(std::ceil(segment_contour_halo({}, planes, kMillimetres) / kMillimetres.step));
  LatticeBox bounds;
  for (const LatticePoint& p : tile.positions) bounds.include(p);
  const std::int64_t cut = any(bounds.min[0], bounds.max[0] + 1);
  std::vector<OutlineEdge> edges;
  for (const bool upper : {true, false}) {
    LatticeBox core = test::everything();
    (upper ? core.min : core.max)[0] = cut;
    const TilePoints part = test::part_of(tile, core, halo);
    std::vector<std::uint32_t> part_labels;
    for (const std::uint64_t id : part.ids) part_labels.push_back(label_of.at(id));
    const SegmentContours contours = analyse_segment_contours(part, part_labels, planes, kMillimetres, {});
    edges.insert(edges.end(), contours.edges.begin(), contours.edges.end());
  }
  const std::vector<SegmentOutline> outlines = link_outlines(edges, planes, kMillimetres);
  RC_ASSERT(edges_in(outlines) == edges.size());
  for (const SegmentOutline& outline : outlines) {
    const OutlinePlane plane(planes[outline.segment - 1]);
    for (const OutlinePolygon& polygon : outline.polygons) RC_ASSERT(is_valid(polygon, plane));
  }
}

TEST(SegmentOutlines, PlatesWithAHole_HaveTheirAreas) {
  test::Sampling sampling;
  sampling.noise = 0.1;
  const test::Scene scene = test::plates_scene(sampling, 4.0);
  const TilePoints tile = test::tile_of(scene, kMillimetres.step);
  std::vector<std::uint32_t> labels;
  for (const std::uint64_t id : tile.ids) labels.push_back(1 + scene.faces[id]);
  const std::vector<SegmentPlane> planes = test::planes_of(tile.positions, labels, scene.spacing / kMillimetres.step);
  const SegmentContours contours = analyse_segment_contours(tile, labels, planes, kMillimetres, {});
  const std::vector<SegmentOutline> outlines = link_outlines(contours.edges, planes, kMillimetres);
  ASSERT_EQ(outlines.size(), planes.size());
  for (const SegmentOutline& outline : outlines) {
    ASSERT_EQ(outline.polygons.size(), 1U);
    EXPECT_EQ(outline.polygons[0].holes.size(), 1U);
    const double points = static_cast<double>(std::count(labels.begin(), labels.end(), outline.segment));
    // The outline runs through the outermost points, half a spacing inside of the border that they stand for.
    const double area = points * scene.spacing * scene.spacing;
    EXPECT_LT(outline.area, area);
    EXPECT_GT(outline.area, 0.93 * area);
  }
}

}  // namespace
}  // namespace arris::merge
