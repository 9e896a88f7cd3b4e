#include "synth/scan_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/parallel.h"
#include "scene_testing.h"
#include "support/sanitizers.h"
#include "synth/polylines.h"
#include "synth/scan_visibility.h"

namespace arris::synth {
namespace {

constexpr double kEye = 1.7;
constexpr double kCorner = 0.03;  // Where borders meet edges of the model they are drawn in the fine raster only.
const ScanGrid kGrid{0.002, 0.002, -std::sqrt(3.0) / 2.0, 0.9659, 120.0};  // Down to 60 degrees below the horizon.
const Material kAny{};

void add_ground(SceneModel& model, double half) {
  model.rectangle({-half, -half, 0}, {half, -half, 0}, {-half, half, 0}, kAny);
  model.loop(EdgeKind::kBoundary, "ground_border",
             {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}});
}

void add_box(SceneModel& model, const Vec3& low, const Vec3& high) {
  const std::vector<Vec3> foot{
      {low.x, low.y, low.z}, {high.x, low.y, low.z}, {high.x, high.y, low.z}, {low.x, high.y, low.z}};
  std::vector<Vec3> top = foot;
  for (Vec3& corner : top) corner.z = high.z;
  for (std::size_t i = 0; i < 4; ++i) {
    model.rectangle(foot[i], foot[(i + 1) % 4], top[i], kAny);
    model.segment(EdgeKind::kConvex, "box", foot[i], top[i], 90.0);
  }
  model.rectangle(top[0], top[1], top[3], kAny);
  model.loop(EdgeKind::kConvex, "box", top, 90.0);
  model.loop(EdgeKind::kConcave, "footing", foot, 90.0);
}

/// A box of 1 m before a wall 8 m from the scanner.
SceneModel box_before_wall() {
  SceneModel model;
  add_ground(model, 10.0);
  add_box(model, {4, -0.5, 0}, {5, 0.5, 1});
  model.rectangle({8, -5, 0}, {8, 5, 0}, {8, -5, 4}, kAny);
  model.segment(EdgeKind::kConcave, "wall_foot", {8, -5, 0}, {8, 5, 0}, 90.0);
  model.segment(EdgeKind::kBoundary, "wall_top", {8, -5, 4}, {8, 5, 4});
  for (const double y : {-5.0, 5.0}) model.segment(EdgeKind::kBoundary, "wall_side", {8, y, 0}, {8, y, 4});
  model.stations.push_back({{0, 0, kEye}});
  return model;
}

template <class Wanted>
double length_of(const std::vector<TruthEdge>& edges, const Wanted& wanted) {
  double sum = 0.0;
  for (const TruthEdge& edge : edges) {
    if (wanted(edge)) sum += edge.length();
  }
  return sum;
}

auto of_role(const std::string& role) {
  return [role](const TruthEdge& edge) { return edge.role == role; };
}

Vec3 middle(const TruthEdge& edge) {
  return edge.point_at(0.5);
}

TEST(ScanTruth_BoxBeforeWall, ShadowOnTheWall_IsTheProjectedOutlineOfTheBox) {
  // Rays through the box's near corners (4, +-0.5), and over its far upper edge (x = 5), meet the wall at x = 8.
  std::vector<TruthEdge> exact;
  for (const double side : {-1.0, 1.0}) {
    exact.push_back(evaluate::make_segment(EdgeKind::kBoundary, "", {8, side, 0}, {8, side, 0.3}));
    exact.push_back(evaluate::make_segment(EdgeKind::kBoundary, "", {8, side, 0.3}, {8, 0.8 * side, 0.58}));
  }
  exact.push_back(evaluate::make_segment(EdgeKind::kBoundary, "", {8, -0.8, 0.58}, {8, 0.8, 0.58}));
  const auto edges = scan_truth(box_before_wall(), kGrid);
  const auto on_wall = [](const TruthEdge& edge) {
    return edge.role == "occlusion" && std::abs(middle(edge).x - 8) < 1e-6 && middle(edge).z > 1e-3;
  };
  for (const TruthEdge& edge : edges) {
    if (!on_wall(edge)) continue;
    for (const Vec3& p : {edge.a, edge.b}) {
      if (p.z < kCorner) continue;
      double nearest = 1e9;
      for (const TruthEdge& one : exact) nearest = std::min(nearest, one.distance(p));
      EXPECT_LT(nearest, 5e-4) << p.y << " " << p.z;
    }
  }
  EXPECT_NEAR(length_of(edges, on_wall), 2 * 0.3 + 2 * std::hypot(0.2, 0.28) + 1.6, 0.02);
}

TEST(ScanTruth_BoxBeforeWall, ShadowOnTheGround_RunsFromTheBoxToTheWall) {
  const auto edges = scan_truth(box_before_wall(), kGrid);
  const auto on_ground = [](const TruthEdge& edge) {
    const Vec3 p = middle(edge);
    return edge.role == "occlusion" && std::abs(p.z) < 1e-9 && p.x > 2 && p.x < 8;
  };
  for (const TruthEdge& edge : edges) {
    if (on_ground(edge) && std::min(edge.a.x, edge.b.x) > 4 + kCorner && edge.a.x < 8 - kCorner) {
      EXPECT_NEAR(std::abs(edge.a.y), 0.125 * edge.a.x, 5e-4);
    }
  }
  EXPECT_NEAR(length_of(edges, on_ground), 2 * std::hypot(4, 0.5), 2 * kCorner);
}

TEST(ScanTruth_BoxBeforeWall, HiddenEdges_AreLeftOutAndHalfHiddenFoldsAreBoundaries) {
  const auto edges = scan_truth(box_before_wall(), kGrid);
  // The near foot of the box is seen from both sides; its other feet are not seen at all.
  EXPECT_NEAR(length_of(edges, of_role("footing")), 1.0, 1e-3);
  // Beside its sides the lit ground begins within a spacing (0.009 m) of the feet for 0.07 m.
  EXPECT_NEAR(length_of(edges, of_role("footing_silhouette")), 2 * 0.07, 0.01);
  // The shadow covers 2 m of the wall's foot. Stepping aside on the ground shortens the seen part by less than 1 cm.
  EXPECT_NEAR(length_of(edges, of_role("wall_foot")), 8.0, 0.02);
  // Folds: the near upper edge. Silhouettes: two near corners, three upper edges.
  EXPECT_NEAR(length_of(edges, of_role("box")), 1.0, 1e-3);
  EXPECT_NEAR(length_of(edges, of_role("box_silhouette")), 2.0 + 3.0, 0.05);
  for (const TruthEdge& edge : edges) {
    EXPECT_EQ(edge.role.ends_with("_silhouette") && (mask(edge.kind) & evaluate::kFoldKinds) != 0, false);
    EXPECT_LE(edge.length(), 0.5 + 1e-9);
    EXPECT_GT(edge.spacing, 0.0);
    EXPECT_GE(edge.spacing_max, edge.spacing * (1 - 1e-9));
  }
}

TEST(ScanTruth_Tripod, HoleInTheGround_IsTheCircleOfTheLowestRays) {
  const double radius = kEye / std::sqrt(3.0);
  const auto edges = scan_truth(box_before_wall(), kGrid);
  const auto hole = [](const TruthEdge& edge) { return edge.role == "occlusion" && norm(middle(edge)) < 2.0; };
  for (const TruthEdge& edge : edges) {
    if (hole(edge)) {
      EXPECT_NEAR(norm(edge.a), radius, 5e-4);
    }
  }
  EXPECT_NEAR(length_of(edges, hole), 2 * std::numbers::pi * radius, 0.01);
}

TEST(ScanTruth_Column, HorizonLines_AreWhereTheSurfaceTurnsAway) {
  constexpr double kRadius = 0.4, kDistance = 6.0, kHeight = 3.0;
  SceneModel model;
  add_ground(model, 10.0);
  model.cylinder({kDistance, 0, 0}, {0, 0, 1}, kHeight, kRadius, kAny);
  model.disc({kDistance, 0, kHeight}, {0, 0, 1}, kRadius, kAny);
  model.circle(EdgeKind::kRimConvex, "top", {kDistance, 0, kHeight}, {0, 0, 1}, kRadius, 90.0);
  model.circle(EdgeKind::kRimConcave, "foot", {kDistance, 0, 0}, {0, 0, 1}, kRadius, 90.0);
  model.stations.push_back({{0, 0, kEye}});
  const auto edges = scan_truth(model, kGrid);
  const auto horizon = [](const TruthEdge& edge) { return edge.role == "occlusion" && middle(edge).z > 1e-3; };
  for (const TruthEdge& edge : edges) {
    if (!horizon(edge) || edge.a.z < kCorner || edge.a.z > kHeight - kCorner) continue;
    const Vec3 outward = (1.0 / kRadius) * Vec3{edge.a.x - kDistance, edge.a.y, 0};
    const Vec3 ray = normalized(edge.a - Vec3{0, 0, kEye});
    EXPECT_NEAR(-dot(ray, outward), ScanVisibility::kLeastCosine, 5e-4 / kRadius);
  }
  EXPECT_NEAR(length_of(edges, horizon), 2 * kHeight, 0.01);
  // Half the circle less what is beyond the horizon; the disc on top is above the scanner.
  const double seen = 2 * kRadius * std::acos(kRadius / kDistance);
  EXPECT_NEAR(length_of(edges, of_role("foot")), seen, 0.02);
  EXPECT_NEAR(length_of(edges, of_role("top_silhouette")), seen, 0.02);
  EXPECT_EQ(length_of(edges, of_role("top")), 0.0);
}

TEST(ScanTruth_TwoStations, ShadowBorderThatTheOtherSees_IsNoBoundary) {
  SceneModel model;
  add_ground(model, 8.0);
  add_box(model, {-0.5, -0.5, 0}, {0.5, 0.5, 1});
  for (const double x : {-5.0, 5.0}) model.stations.push_back({{x, 0, kEye}});
  const auto edges = scan_truth(model, kGrid);
  const auto shadow = [](const TruthEdge& edge) {
    return edge.role == "occlusion" && std::abs(std::abs(middle(edge).x) - 5.0) > 1.5;
  };
  // Unseen by both: beside each of two sides of the box the triangle under the lines (-+5, 0) - (-+0.5, 0.5).
  EXPECT_NEAR(length_of(edges, shadow), 4 * std::hypot(0.5, 0.5 / 9.0), 4 * kCorner);
  for (const TruthEdge& edge : edges) {
    if (shadow(edge)) {
      EXPECT_LT(std::abs(edge.a.x), 0.5 + 1e-3);
    }
  }
  // The holes under the tripods are seen by the other station, but more than five times as sparsely.
  const auto hole = [&](const TruthEdge& edge) { return edge.role == "occlusion" && !shadow(edge); };
  EXPECT_NEAR(length_of(edges, hole), 4 * std::numbers::pi * kEye / std::sqrt(3.0), 0.02);
}

TEST(ScanTruth_Sheet, OverAHiddenWall_HasNoEdgeThere) {
  // Seen from above, a roof goes straight on over the wall that carries it.
  SceneModel model;
  model.rectangle({3, -2, 0}, {3, 2, 0}, {3, -2, 1}, kAny);
  model.rectangle({1.5, -2, 1}, {5, -2, 1}, {1.5, 2, 1}, kAny);
  model.segment(EdgeKind::kConcave, "soffit", {3, -2, 1}, {3, 2, 1}, 90.0);
  model.stations.push_back({{0, 0, 3}});
  EXPECT_TRUE(scan_truth(model, kGrid).empty());
}

TEST(ScanVisibility_Spacing, OnTheGround_IsThatOfTheSphericalGrid) {
  SceneModel model;
  add_ground(model, 50.0);
  model.stations.push_back({{0, 0, kEye}});
  const ScanVisibility visibility(model, kGrid);
  for (const double distance : {2.0, 7.0, 30.0}) {
    const SurfacePoint point{{0.6 * distance, 0.8 * distance, 0}, {0, 0, 1}, 0};
    const double range = std::hypot(distance, kEye);
    const LocalSpacing spacing = visibility.spacing(point, 1);
    EXPECT_NEAR(spacing.coarse, range * range * kGrid.elevation_step_rad / kEye, 1e-9);
    EXPECT_NEAR(spacing.mean, std::sqrt(spacing.coarse * distance * kGrid.azimuth_step_rad), 1e-9);
  }
}

TEST(ScanTruth_Town, TruthOfScan_HasPointsBesideEveryPieceAndNoneOfTheModelsHiddenEdges) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  const Scene scene(request_of("town", 300000));
  const evaluate::Truth truth = scene.truth(), model = scene.truth(TruthOf::kModel);
  EXPECT_EQ(truth.properties.at("truth_of"), "scan");
  EXPECT_EQ(model.edges, scene.edges());
  // The back wall of the house at (-27, 13), 13 x 9 m, heading 2 degrees, is not seen by any of the four stations.
  for (const TruthEdge& edge : truth.edges) {
    const Vec3 p = edge.point_at(0.5);
    EXPECT_FALSE(std::abs(p.x + 27) < 5.5 && p.y > 17 && p.y < 18 && p.z < 5) << edge.role;
  }
  const auto points = all_points(scene);
  const evaluate::BoxTree tree(points.size(), [&](std::size_t i) {
    const Vec3 p{points[i].x, points[i].y, points[i].z};
    return Box3{p, p};
  });
  double far = 0.0, all = 0.0;
  for (const TruthEdge& edge : truth.edges) {
    const Vec3 p = edge.point_at(0.5);
    double limit = std::numeric_limits<double>::infinity();
    tree.search(p, limit, [&](std::uint32_t i) {
      const Vec3 d = Vec3{points[i].x, points[i].y, points[i].z} - p;
      limit = std::min(limit, dot(d, d));
    });
    all += edge.length();
    if (limit > 4.0 * edge.spacing_max * edge.spacing_max) far += edge.length();
  }
  EXPECT_LT(far, 0.002 * all);
}

TEST(ScanTruth_Threads, AnyNumber_GivesTheSameBytes) {
  SceneModel model = box_before_wall();
  model.stations.push_back({{-3, 4, kEye}});
  std::vector<std::string> texts;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    evaluate::Truth truth;
    truth.edges = scan_truth(model, kGrid);
    std::ostringstream text;
    write_truth_csv(text, truth);
    texts.push_back(text.str());
  }
  EXPECT_EQ(texts[0], texts[1]);
}

TEST(Polylines_Join, ChainsAndRings_KeepTheirOrderAndLoseStraightVertices) {
  const auto at = [](double x, double y) { return Vec3{x, y, 0}; };
  const std::vector<KeyedSegment> segments{{2, 1, at(1, 0), at(0, 0)},
                                           {2, 3, at(1, 0), at(2, 0)},
                                           {10, 11, at(5, 0), at(6, 0)},
                                           {11, 12, at(6, 0), at(6, 1)},
                                           {12, 10, at(6, 1), at(5, 0)}};
  const auto lines = join_segments(segments);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(simplify(lines[0], 1e-3), (std::vector<Vec3>{at(0, 0), at(2, 0)}));
  ASSERT_EQ(lines[1].size(), 4U);
  EXPECT_EQ(lines[1].front(), lines[1].back());
  EXPECT_EQ(simplify(lines[1], 1e-3).size(), 4U);
}

}  // namespace
}  // namespace arris::synth
