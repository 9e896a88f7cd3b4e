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
                         testing::Values("block", "plates", "stairs", "gable", "hip", "dihedral", "plane"),
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
