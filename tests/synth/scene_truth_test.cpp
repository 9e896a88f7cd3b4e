#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <sstream>

#include "scene_testing.h"

namespace arris::synth {
namespace {

using evaluate::EdgeKind;
using evaluate::TruthEdge;
using evaluate::Vec3;

std::map<EdgeKind, double> lengths(const Scene& scene) {
  std::map<EdgeKind, double> result;
  for (const TruthEdge& edge : scene.edges()) result[edge.kind] += edge.length();
  return result;
}

/// Directions (degrees) in which faces leave an edge, found by walking round its middle on a small circle across it.
std::vector<double> faces_around(const Scene& scene, const TruthEdge& edge) {
  constexpr int kSteps = 3600;
  constexpr double kRadius = 1e-4;
  const Vec3 middle = edge.point_at(0.5);
  const Vec3 along = normalized(edge.point_at(0.5 + 1e-7) - edge.point_at(0.5 - 1e-7));
  const Vec3 helper = std::abs(along.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = normalized(cross(along, helper)), v = cross(along, u);
  std::vector<double> distances;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSteps;
    const Vec3 p = middle + kRadius * std::cos(angle) * u + kRadius * std::sin(angle) * v;
    distances.push_back(scene.distance({p.x, p.y, p.z}));
  }
  std::vector<double> directions;
  for (int i = 0; i < kSteps; ++i) {
    const double before = distances[(i + kSteps - 1) % kSteps], here = distances[i],
                 after = distances[(i + 1) % kSteps];
    if (here < before && here <= after && here < 0.002 * kRadius) directions.push_back(360.0 * i / kSteps);
  }
  return directions;
}

class SceneTruth : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, SceneTruth,
                         testing::Values("block", "plates", "stairs", "gable", "hip", "dihedral", "plane", "crossgable",
                                         "mansard", "dormer", "dome", "parapet", "columns", "facade", "sculpture",
                                         "corners", "spray"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(SceneTruth, EveryEdge_LiesOnFaces) {
  const Scene scene(request_of(GetParam()));
  for (const TruthEdge& edge : scene.edges()) {
    for (int i = 0; i <= 20; ++i) {
      const Vec3 p = edge.point_at(i / 20.0);
      ASSERT_LT(scene.distance({p.x, p.y, p.z}), 1e-9) << edge.role;
    }
  }
}

TEST_P(SceneTruth, FacesAroundEveryEdge_HaveTheStatedAngle) {
  SceneRequest request = request_of(GetParam());
  if (request.scene == "gable" || request.scene == "hip") request.options = {{"walls", 1}, {"ground", 1}};
  const Scene scene(request);
  for (const TruthEdge& edge : scene.edges()) {
    const auto directions = faces_around(scene, edge);
    const bool boundary = (mask(edge.kind) & evaluate::kBoundaryKinds) != 0;
    ASSERT_EQ(directions.size(), boundary ? 1U : 2U) << edge.role;
    if (boundary) {
      EXPECT_EQ(edge.angle_deg, 0.0);
      continue;
    }
    const double between = std::abs(directions[1] - directions[0]);
    EXPECT_NEAR(std::min(between, 360.0 - between), edge.angle_deg, 0.25) << edge.role;
  }
}

TEST(BlockTruth_Lengths, TwelveEdgesAndFourCircles_AreAsBuilt) {
  const double circle = 14.0 * std::numbers::pi;
  for (const double cavity : {0.0, 1.0}) {
    SceneRequest request = request_of("block");
    request.options["cavity"] = cavity;
    const auto found = lengths(Scene(request));
    EXPECT_NEAR(found.at(EdgeKind::kConvex), 8 * 24 + 4 * 12, 1e-9);
    EXPECT_NEAR(found.at(EdgeKind::kRimConvex), 2 * circle, 1e-9);
    EXPECT_NEAR(found.at(EdgeKind::kRimConcave), 2 * circle, 1e-9);
    EXPECT_EQ(found.size(), 3U);
  }
}

TEST(PlatesTruth_Lengths, TwoSquaresAndTwoHoles_AreBoundaries) {
  const auto found = lengths(Scene(request_of("plates")));
  EXPECT_NEAR(found.at(EdgeKind::kBoundary), 80.0, 1e-9);
  EXPECT_NEAR(found.at(EdgeKind::kRimBoundary), 6.0 * std::numbers::pi, 1e-9);
  EXPECT_EQ(found.size(), 2U);
}

TEST(StairsTruth_Lengths, NosingsAndInnerCorners_AreCounted) {
  SceneRequest request = request_of("stairs");
  request.options = {{"steps", 10}, {"width", 2}};
  const auto found = lengths(Scene(request));
  EXPECT_NEAR(found.at(EdgeKind::kConvex), 20.0, 1e-9);
  EXPECT_NEAR(found.at(EdgeKind::kConcave), 18.0, 1e-9);
  EXPECT_NEAR(found.at(EdgeKind::kBoundary), 4.0 + 2 * 10 * 0.45, 1e-9);
}

TEST(DihedralTruth_Angles, FromThirtyTo170_EachHasOneFold) {
  const Scene scene(request_of("dihedral"));
  std::map<double, int> angles;
  for (const TruthEdge& edge : scene.edges()) {
    if (edge.kind == EdgeKind::kConvex) ++angles[edge.angle_deg];
  }
  ASSERT_EQ(angles.size(), 15U);
  for (int angle = 30; angle <= 170; angle += 10) EXPECT_EQ(angles[angle], 1);
}

TEST(RoundEdgeTruth_Folds, AreTheMiddlesOfRoundsUpToOneSpacing) {
  SceneRequest request = request_of("roundedge");
  request.spacing = 0.05;
  const Scene scene(request);
  std::map<std::string, TruthEdge> folds;
  for (const TruthEdge& edge : scene.edges()) {
    if (edge.kind == EdgeKind::kConvex) folds[edge.role] = edge;
    for (int i = 0; i <= 4; ++i) {
      const Vec3 p = edge.point_at(i / 4.0);
      ASSERT_LT(scene.distance({p.x, p.y, p.z}), 1e-9) << edge.role;
    }
  }
  ASSERT_EQ(folds.size(), 5U);
  EXPECT_EQ(folds.at("radius_0").a.z, 0.0);
  EXPECT_NEAR(folds.at("radius_100").a.z, -0.05 * (1.0 - std::sqrt(0.5)), 1e-12);
  EXPECT_FALSE(folds.contains("radius_200"));
}

TEST(MansardTruth_Lengths, HipsBreakAndRidge_AreAsBuilt) {
  const auto found = lengths(Scene(request_of("mansard")));
  const double inset = 3.0 / std::tan(70.0 / 180.0 * std::numbers::pi);
  const double x = 8.0 - inset, y = 5.5 - inset, rise = y * std::tan(25.0 / 180.0 * std::numbers::pi);
  EXPECT_NEAR(found.at(EdgeKind::kBoundary), 54.0, 1e-9);
  EXPECT_NEAR(found.at(EdgeKind::kConvex),
              4 * std::hypot(3.0, inset, inset) + 4 * (x + y) + 4 * std::hypot(y, y, rise) + 2 * (8.0 - 5.5), 1e-9);
}

TEST(RoofTruth_Valleys, OfCrossGableAndDormer_AreFourAndSix) {
  for (const auto& [scene, wanted] : {std::pair{"crossgable", 4}, std::pair{"dormer", 6}}) {
    int valleys = 0;
    const Scene built(request_of(scene));
    for (const TruthEdge& edge : built.edges()) valleys += edge.role == "valley" ? 1 : 0;
    EXPECT_EQ(valleys, wanted) << scene;
  }
}

TEST(SculptureTruth_Arcs, EachLetterHasEight) {
  int arcs = 0;
  const Scene scene(request_of("sculpture"));
  for (const TruthEdge& edge : scene.edges()) {
    arcs += edge.shape == TruthEdge::Shape::kArc && edge.sweep_deg == 270.0 ? 1 : 0;
  }
  EXPECT_EQ(arcs, 3 * 8);
}

TEST(SprayScene_StrayPoints, AreAsManyAndAsNearAsAskedFor) {
  SceneRequest request = request_of("spray", 50000);
  request.options = {{"share", 0.1}, {"reach", 0.3}};
  double stray = 0.0, all = 0.0;
  for (const auto& p : all_points(Scene(request))) {
    ++all;
    if (p.classification == 7) ++stray;
    ASSERT_LE(std::abs(p.y), 0.3);
  }
  EXPECT_NEAR(stray / all, 0.1, 0.01);
}

TEST(FeaturelessTruth_SphereNoiseAndPlane, HaveNoFolds) {
  EXPECT_TRUE(Scene(request_of("sphere")).edges().empty());
  EXPECT_TRUE(Scene(request_of("noise")).edges().empty());
  const Scene plane(request_of("plane"));
  for (const TruthEdge& edge : plane.edges()) EXPECT_EQ(edge.role, "border");
}

TEST(TruthOfScene_Written, ReadsBackWithItsProperties) {
  SceneRequest request = request_of("hip", 12345);
  request.noise = 0.1;
  request.seed = 18446744073709551615ULL;
  request.rotate = true;
  request.shift = {500000.1, 5000000.2, 0.3};
  const Scene scene(request);
  std::stringstream text;
  write_truth_csv(text, scene.truth());
  const evaluate::Truth truth = evaluate::read_truth_csv(text, "truth.csv");
  EXPECT_EQ(truth, scene.truth());
  EXPECT_EQ(truth.edges, scene.edges());
  EXPECT_EQ(truth.number("spacing", 0.0), scene.spacing());
  EXPECT_EQ(truth.number("noise", 0.0), 0.1);
  EXPECT_EQ(truth.properties.at("seed"), "18446744073709551615");
  EXPECT_EQ(truth.properties.at("scene"), "hip");
  EXPECT_EQ(truth.number("option_length", 0.0), 12.0);
}

}  // namespace
}  // namespace arris::synth
