// Rings of alpha shapes of random and degenerate clouds, and shapes that are known.

#include "merge/outline_rings.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "features/planar/alpha_edges.h"
#include "merge/outline_plane.h"
#include "merge/outline_simplification.h"
#include "merge/outline_validity.h"
#include "random_clouds.h"
#include "tile_laws.h"

namespace arris::merge {
namespace {

using test::any;

const Lattice kLattice{0.01, {100.0, 200.0, 300.0}};

SegmentPlane tilted_plane() {
  SegmentPlane plane;
  plane.normal = {0.36, 0.48, 0.8};
  plane.spacing = 10.0;
  return plane;
}

/// The outline of points of one segment, made point by point.
std::vector<OutlineEdge> edges_of(const std::vector<LatticePoint>& points, const SegmentPlane& plane, double alpha) {
  const OutlinePlane on_plane(plane);
  std::vector<OutlineEdge> edges;
  AlphaEdges alpha_edges;
  std::vector<PlanePosition> at;
  for (const LatticePoint& p : points) at.push_back(on_plane(p));
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    std::vector<PlanarNeighbour> around;
    for (std::uint32_t q = 0; q < points.size(); ++q) {
      if (at[q] != at[p]) around.push_back({at[q].x - at[p].x, at[q].y - at[p].y, q});
    }
    for (const PlanarNeighbour& q : alpha_edges.leaving(around, frame_units(2.0 * alpha))) {
      edges.push_back({1, p, q.index, points[p], points[q.index]});
    }
  }
  return edges;
}

/// Distinct points with grids, holes and touching corners.
std::vector<LatticePoint> random_points(std::uint64_t seed) {
  std::set<LatticePoint> points;
  const bool grid = seed % 3 != 0;
  const std::int32_t pitch = grid ? 10 : 1;
  const std::int32_t side = any(3, 14);
  const int count = any(3, side * side);
  for (int i = 0; i < count; ++i) {
    points.insert({any(0, side * 10) / pitch * pitch, any(0, side * 10) / pitch * pitch, 0});
  }
  return {points.begin(), points.end()};
}

struct Case {
  SegmentPlane plane;
  std::vector<OutlineEdge> edges;
};

Case any_case() {
  Case c;
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  if (seed % 2 == 0) c.plane = tilted_plane();
  const double alpha = *rc::gen::element(7.5, 10.0, 12.5, 20.0);
  c.edges = edges_of(random_points(seed), c.plane, alpha);
  return c;
}

std::vector<OutlineEdge> edges_of(const SegmentOutline& outline) {
  std::vector<OutlineEdge> edges;
  const auto add = [&](const OutlineRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const OutlineVertex &v = ring[i], &w = ring[(i + 1) % ring.size()];
      edges.push_back({outline.segment, v.id, w.id, v.position, w.position});
    }
  };
  for (const OutlinePolygon& polygon : outline.polygons) {
    add(polygon.outer);
    for (const OutlineRing& hole : polygon.holes) add(hole);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

bool same(const SegmentOutline& a, const SegmentOutline& b) {
  const auto equal = [](const OutlinePolygon& p, const OutlinePolygon& q) {
    return p.outer == q.outer && p.holes == q.holes && p.area == q.area;
  };
  return a.segment == b.segment && a.area == b.area &&
         std::equal(a.polygons.begin(), a.polygons.end(), b.polygons.begin(), b.polygons.end(), equal);
}

RC_GTEST_PROP(OutlineRings, AnyShape_UsesEveryEdgeOnceInValidPolygons, ()) {
  Case c = any_case();
  const SegmentOutline outline = link_outline(c.edges, c.plane, kLattice);
  std::sort(c.edges.begin(), c.edges.end());
  RC_ASSERT(edges_of(outline) == c.edges);
  std::size_t holes = 0;
  double area = 0.0;
  for (const OutlinePolygon& polygon : outline.polygons) {
    RC_ASSERT(is_valid(polygon, OutlinePlane(c.plane)));
    RC_ASSERT(polygon.area > 0.0);
    RC_ASSERT(polygon.outer[0] == *std::min_element(polygon.outer.begin(), polygon.outer.end()));
    RC_ASSERT(std::is_sorted(polygon.holes.begin(), polygon.holes.end()));
    std::set<std::uint64_t> ids;
    for (const OutlineVertex& v : polygon.outer) ids.insert(v.id);
    RC_ASSERT(ids.size() == polygon.outer.size());
    holes += polygon.holes.size();
    area += polygon.area;
  }
  RC_CLASSIFY(holes > 0, "has holes");
  RC_CLASSIFY(outline.polygons.size() > 1, "several polygons");
  RC_ASSERT(std::fabs(area - outline.area) <= 1e-9 * area);
}

RC_GTEST_PROP(OutlineRings, OrderOfEdges_ChangesNothing, ()) {
  const Case c = any_case();
  std::vector<OutlineEdge> shuffled = c.edges;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937_64(*rc::gen::arbitrary<std::uint64_t>()));
  RC_ASSERT(same(link_outline(c.edges, c.plane, kLattice), link_outline(shuffled, c.plane, kLattice)));
}

RC_GTEST_PROP(OutlineRings, EdgesMissing_LeaveClosedRings, ()) {
  Case c = any_case();
  std::erase_if(c.edges, [](const OutlineEdge&) { return any(0, 20) == 0; });
  const SegmentOutline outline = link_outline(c.edges, c.plane, kLattice);
  std::sort(c.edges.begin(), c.edges.end());
  const std::vector<OutlineEdge> used = edges_of(outline);
  RC_ASSERT(std::includes(c.edges.begin(), c.edges.end(), used.begin(), used.end()));
}

/// Law: vertices that are left out are near the new rings, and polygons stay valid.
RC_GTEST_PROP(OutlineSimplification, AnyShape_StaysValidAndNear, ()) {
  const Case c = any_case();
  const SegmentOutline before = link_outline(c.edges, c.plane, kLattice);
  SegmentOutline after = before;
  const double tolerance = *rc::gen::element(0.02, 0.05, 0.3);
  simplify_outline(after, c.plane, kLattice, tolerance);
  const OutlinePlane plane(c.plane);
  const double steps = tolerance / kLattice.step / std::sqrt(plane.square_steps());
  for (std::size_t i = 0; i < before.polygons.size(); ++i) {
    const OutlinePolygon &b = before.polygons[i], &a = after.polygons[i];
    RC_CLASSIFY(a.outer.size() < b.outer.size(), "simplified");
    RC_ASSERT(is_valid(a, plane));
    RC_ASSERT(a.area == b.area);
    for (const OutlineVertex& v : b.outer) {
      const PlanePosition p = plane(v.position);
      double least = INFINITY;
      for (std::size_t k = 0; k < a.outer.size(); ++k) {
        const PlanePosition s = plane(a.outer[k].position), t = plane(a.outer[(k + 1) % a.outer.size()].position);
        const double x = double(t.x - s.x), y = double(t.y - s.y), px = double(p.x - s.x), py = double(p.y - s.y);
        const double along = std::clamp((x * px + y * py) / (x * x + y * y), 0.0, 1.0);
        least = std::min(least, std::hypot(px - along * x, py - along * y));
      }
      RC_ASSERT(least <= steps * (1.0 + 1e-9));
    }
  }
}

/// Cells of 10 x 10 steps of a picture, each a filled square of its four corners.
SegmentOutline outline_of(const std::vector<std::string>& picture, const SegmentPlane& plane = {}) {
  // The border of the cells: the interior is to the left.
  std::set<std::pair<LatticePoint, LatticePoint>> sides;
  const auto point = [](int x, int y) { return LatticePoint{10 * x, 10 * y, 0}; };
  for (int row = 0; row < static_cast<int>(picture.size()); ++row) {
    for (int x = 0; x < static_cast<int>(picture[static_cast<std::size_t>(row)].size()); ++x) {
      if (picture[static_cast<std::size_t>(row)][static_cast<std::size_t>(x)] != '#') continue;
      const int y = static_cast<int>(picture.size()) - 1 - row;
      const LatticePoint corners[5] = {point(x, y), point(x + 1, y), point(x + 1, y + 1), point(x, y + 1), point(x, y)};
      for (int k = 0; k < 4; ++k) {
        if (sides.erase({corners[k + 1], corners[k]}) == 0) sides.emplace(corners[k], corners[k + 1]);
      }
    }
  }
  std::vector<OutlineEdge> edges;
  const auto id = [](const LatticePoint& p) { return static_cast<std::uint64_t>(p.y * 100 + p.x); };
  for (const auto& [a, b] : sides) edges.push_back({1, id(a), id(b), a, b});
  return link_outline(edges, plane, kLattice);
}

TEST(OutlineRings, Frame_HasAHole) {
  const SegmentOutline outline = outline_of({"####", "#..#", "####"});
  ASSERT_EQ(outline.polygons.size(), 1U);
  EXPECT_EQ(outline.polygons[0].outer.size(), 14U);
  ASSERT_EQ(outline.polygons[0].holes.size(), 1U);
  EXPECT_EQ(outline.polygons[0].holes[0].size(), 6U);
  EXPECT_NEAR(outline.area, 10 * 0.01, 1e-5 * 0.1);
}

TEST(OutlineRings, IslandInAHole_IsAPolygonOfItsOwn) {
  const SegmentOutline outline =
      outline_of({"#######", "#.....#", "#.###.#", "#.#.#.#", "#.###.#", "#.....#", "#######"});
  ASSERT_EQ(outline.polygons.size(), 2U);
  EXPECT_EQ(outline.polygons[0].outer.size(), 28U);
  ASSERT_EQ(outline.polygons[0].holes.size(), 1U);
  EXPECT_EQ(outline.polygons[0].holes[0].size(), 20U);
  EXPECT_EQ(outline.polygons[1].outer.size(), 12U);
  ASSERT_EQ(outline.polygons[1].holes.size(), 1U);
  EXPECT_EQ(outline.polygons[1].holes[0].size(), 4U);
}

TEST(OutlineRings, SquaresThatTouchInACorner_AreTwoPolygons) {
  const SegmentOutline outline = outline_of({".#", "#."});
  ASSERT_EQ(outline.polygons.size(), 2U);
  EXPECT_EQ(outline.polygons[0].outer.size(), 4U);
  EXPECT_EQ(outline.polygons[1].outer.size(), 4U);
}

TEST(OutlineRings, RingThatTouchesItselfInACorner_IsAPolygonWithAHole) {
  // The two cells at the lower right touch in a corner, where the hole touches the outer ring.
  const SegmentOutline outline = outline_of({"###", "#.#", "##."});
  ASSERT_EQ(outline.polygons.size(), 1U);
  ASSERT_EQ(outline.polygons[0].holes.size(), 1U);
  EXPECT_EQ(outline.polygons[0].holes[0].size(), 4U);
  EXPECT_TRUE(is_valid(outline.polygons[0], OutlinePlane(SegmentPlane{})));
}

TEST(OutlineRings, AreaInATiltedPlane_IsThatOfTheSurface) {
  // A rectangle of 5 x 3 m on the plane 0.6 x + 0.8 z = 0.
  SegmentPlane plane;
  plane.normal = {0.6, 0.0, 0.8};
  const std::vector<LatticePoint> p{{0, 0, 0}, {400, 0, -300}, {400, 300, -300}, {0, 300, 0}};
  std::vector<OutlineEdge> edges;
  for (std::uint64_t i = 0; i < 4; ++i) edges.push_back({1, i, (i + 1) % 4, p[i], p[(i + 1) % 4]});
  EXPECT_NEAR(link_outline(edges, plane, kLattice).area, 15.0, 1e-9);
}

TEST(OutlineRings, SeveralSegments_ComeInOrder) {
  const std::vector<LatticePoint> p{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
  std::vector<OutlineEdge> edges;
  for (const std::uint32_t segment : {3U, 1U}) {
    for (std::uint64_t i = 0; i < 3; ++i) {
      edges.push_back({segment, 10 * segment + i, 10 * segment + (i + 1) % 3, p[i], p[(i + 1) % 3]});
    }
  }
  const std::vector<SegmentPlane> planes(3);
  const std::vector<SegmentOutline> outlines = link_outlines(edges, planes, kLattice);
  ASSERT_EQ(outlines.size(), 2U);
  EXPECT_EQ(outlines[0].segment, 1U);
  EXPECT_EQ(outlines[1].segment, 3U);
  EXPECT_EQ(outlines[1].polygons[0].outer[0].id, 30U);
  EXPECT_TRUE(link_outlines({}, planes, kLattice).empty());
}

TEST(OutlineSimplification, Rectangle_KeepsItsCorners) {
  SegmentOutline outline = outline_of({"######", "######", "######"});
  simplify_outline(outline, SegmentPlane{}, kLattice, 0.01);
  ASSERT_EQ(outline.polygons.size(), 1U);
  EXPECT_EQ(outline.polygons[0].outer.size(), 4U);
}

TEST(OutlineValidity, FaultyPolygons_AreRefused) {
  const auto ring = [](std::initializer_list<LatticePoint> points, std::uint64_t id) {
    OutlineRing made;
    for (const LatticePoint& p : points) made.push_back({id++, p});
    return made;
  };
  const OutlinePlane plane{SegmentPlane{}};
  const OutlineRing square = ring({{0, 0, 0}, {0, 90, 0}, {90, 90, 0}, {90, 0, 0}}, 0);
  OutlineRing clockwise = square, outer = square;
  const bool first_is_outer = is_valid({square, {}, 0.0}, plane);
  std::reverse((first_is_outer ? clockwise : outer).begin(), (first_is_outer ? clockwise : outer).end());
  EXPECT_TRUE(is_valid({outer, {}, 0.0}, plane));
  EXPECT_FALSE(is_valid({clockwise, {}, 0.0}, plane));
  const auto hole = [&](std::initializer_list<LatticePoint> points) {
    OutlineRing made = ring(points, 100);
    if (first_is_outer) return made;
    std::reverse(made.begin(), made.end());
    return made;
  };
  const OutlineRing inside = hole({{10, 10, 0}, {20, 10, 0}, {20, 20, 0}});
  const OutlineRing outside = hole({{110, 10, 0}, {120, 10, 0}, {120, 20, 0}});
  const OutlineRing across = hole({{10, 10, 0}, {120, 10, 0}, {120, 20, 0}});
  EXPECT_TRUE(is_valid({outer, {inside}, 0.0}, plane));
  EXPECT_FALSE(is_valid({outer, {outside}, 0.0}, plane));
  EXPECT_FALSE(is_valid({outer, {across}, 0.0}, plane));
  EXPECT_FALSE(is_valid({ring({{0, 0, 0}, {90, 90, 0}, {90, 0, 0}, {0, 90, 0}}, 0), {}, 0.0}, plane));
}

}  // namespace
}  // namespace arris::merge
