#include "synth/airborne.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "scene_testing.h"
#include "synth/surface_numbers.h"

namespace arris::synth {
namespace {

const std::vector<std::string> kRoofs{"gable", "hip", "crossgable", "mansard", "dormer", "dome", "parapet"};

SceneRequest airborne(const std::string& scene, std::map<std::string, double> options) {
  SceneRequest request = request_of(scene);
  request.spacing = 0.2;
  request.sampling = "random";
  request.options = std::move(options);
  return request;
}

class EveryRoof : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Roofs, EveryRoof, testing::ValuesIn(kRoofs), [](const auto& test) { return test.param; });

TEST_P(EveryRoof, ItsTree_ComesBehindTheSamePointsAndTouchesThem) {
  const auto bare = all_points(Scene(airborne(GetParam(), {})));
  const auto points = all_points(Scene(airborne(GetParam(), {{"tree", 1}})));
  ASSERT_GT(points.size(), bare.size());
  for (std::size_t i = 0; i < bare.size(); ++i) {
    ASSERT_TRUE(bare[i].x == points[i].x && bare[i].y == points[i].y && bare[i].z == points[i].z);
    ASSERT_EQ(points[i].classification, kBuildingClass);
    ASSERT_EQ(points[i].label, bare[i].label);
  }
  double nearest = 1e9;
  for (std::size_t i = bare.size(); i < points.size(); ++i) {
    ASSERT_EQ(points[i].classification, kTreeClass);
    ASSERT_EQ(points[i].label, 0U);
    for (const auto& p : bare) {
      nearest = std::min(nearest, std::hypot(p.x - points[i].x, p.y - points[i].y, p.z - points[i].z));
    }
  }
  EXPECT_LT(nearest, 2 * 0.2);
  // Mean height of an ellipsoid over its plan: two thirds of the returns through its middle.
  const double expected = 2.0 * std::acos(-1.0) * kCrownRadius * kCrownRadius / (0.2 * 0.2);
  EXPECT_NEAR(static_cast<double>(points.size() - bare.size()) / expected, 1.0, 0.15);
}

TEST_P(EveryRoof, ItsCrown_IsAnEllipsoidBesideTheEave) {
  const auto points = all_points(Scene(airborne(GetParam(), {{"tree", 1}})));
  Box3 crown, roof;
  for (const auto& p : points) (p.classification == kTreeClass ? crown : roof).include(Vec3{p.x, p.y, p.z});
  const Vec3 size = crown.max - crown.min, middle = 0.5 * (crown.min + crown.max);
  EXPECT_NEAR(size.x, 2 * kCrownRadius, 0.5);
  EXPECT_NEAR(size.y, 2 * kCrownRadius, 0.5);
  EXPECT_NEAR(size.z, 2 * kCrownHalfHeight, 0.6);
  std::size_t over_the_roof = 0, tree = 0;
  for (const auto& p : points) {
    if (p.classification != kTreeClass) continue;
    const double a = (p.x - middle.x) / kCrownRadius, b = (p.y - middle.y) / kCrownRadius;
    const double c = (p.z - middle.z) / kCrownHalfHeight;
    ASSERT_LT(a * a + b * b + c * c, 1.5);
    ++tree;
    if (p.x > roof.min.x && p.x < roof.max.x && p.y > roof.min.y && p.y < roof.max.y) ++over_the_roof;
  }
  EXPECT_GT(over_the_roof, 0U);
  if (GetParam() != "crossgable") {  // There the box of the roof holds the tree between its wings.
    EXPECT_LT(over_the_roof, tree / 8);
  }
}

TEST_P(EveryRoof, OfTwoMaterials_KeepsItsAreaAndHasMoreSurfaces) {
  const Scene plain(airborne(GetParam(), {})), cut(airborne(GetParam(), {{"materials", 2}}));
  EXPECT_NEAR(cut.expected_points(), plain.expected_points(), 1e-9 * plain.expected_points());
  std::set<std::uint32_t> before, after;
  std::map<std::uint32_t, std::set<int>> intensities;
  for (const auto& p : all_points(plain)) before.insert(p.label);
  for (const auto& p : all_points(cut)) {
    after.insert(p.label);
    intensities[p.label].insert(p.intensity);
    ASSERT_LT(cut.distance({p.x, p.y, p.z}), 1e-9);
  }
  EXPECT_GE(after.size(), before.size());
  if (GetParam() != "dome") {
    EXPECT_GT(after.size(), before.size());
  }
  std::set<int> all;
  for (const auto& [label, values] : intensities) {
    EXPECT_EQ(values.size(), 1U) << label;
    all.insert(*values.begin());
  }
  if (GetParam() != "dome") {
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](int v) { return all.count(v / 2) > 0; }));
  }
}

TEST_P(EveryRoof, QuietOptions_AreNamedOnlyIfTheyAreSet) {
  EXPECT_EQ(Scene(airborne(GetParam(), {})).truth().properties.count("option_tree"), 0U);
  EXPECT_EQ(Scene(airborne(GetParam(), {{"tree", 1}})).truth().properties.at("option_tree"), "1");
}

TEST(Materials_OfAGable, AreCutAcrossTheRidge) {
  for (const auto& p : all_points(Scene(airborne("gable", {{"materials", 2}})))) {
    ASSERT_EQ(p.intensity<15000, p.x> 0.15 * 12.0) << p.x;
  }
}

TEST(Materials_OfAPolygonThatIsNotConvex, BothPartsTogetherAreTheWhole) {
  SceneModel model;
  // A comb whose teeth point along x: the cut meets each of them.
  model.polygon({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 2, 0}, {4, 2, 0}, {4, 3, 0}, {0, 3, 0}}, Material{});
  const double whole = model.faces.front().measure();
  add_airborne(model, {{"tree", 0}, {"materials", 2}, {"intensity_noise", 0}});
  ASSERT_EQ(model.faces.size(), 2U);
  EXPECT_NEAR(model.faces[0].measure() + model.faces[1].measure(), whole, 1e-12);
  EXPECT_NEAR(model.faces[1].measure(), 2 * (4 - 2.6), 1e-12);
  number_surfaces(model.faces);
  EXPECT_NE(model.faces[0].surface, model.faces[1].surface);
  for (double u = 0.05; u < 4.0; u += 0.1) {
    for (double v = 0.05; v < 3.0; v += 0.1) {
      const bool owned = v < 1.0 || v >= 2.0 || u < 1.0;
      ASSERT_EQ(model.faces[0].owns(u, v), owned && u < 2.6) << u << ' ' << v;
      ASSERT_EQ(model.faces[1].owns(u, v), owned && u >= 2.6) << u << ' ' << v;
    }
  }
}

TEST(IntensityNoise_OfARoof, ScattersTheIntensityAndMovesNothing) {
  const auto plain = all_points(Scene(airborne("hip", {}))),
             noisy = all_points(Scene(airborne("hip", {{"intensity_noise", 0.1}})));
  ASSERT_EQ(plain.size(), noisy.size());
  std::vector<double> ratios;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    ASSERT_EQ(plain[i].x, noisy[i].x);
    ratios.push_back(static_cast<double>(noisy[i].intensity) / plain[i].intensity);
  }
  EXPECT_NEAR(mean(ratios), 1.0, 0.01);
  EXPECT_NEAR(standard_deviation(ratios), 0.1, 0.01);
}

TEST(Roofs_Scene, HoldsEveryRoofWithItsSurfaces) {
  std::size_t surfaces = 0, edges = 0;
  for (const std::string& roof : kRoofs) {
    std::set<std::uint32_t> labels;
    const bool walls = roof == "parapet" || roof == "gable" || roof == "hip";
    const Scene scene(
        airborne(roof, walls ? std::map<std::string, double>{{"walls", 0}} : std::map<std::string, double>{}));
    for (const auto& p : all_points(scene)) labels.insert(p.label);
    surfaces += labels.size();
    edges += scene.edges().size();
  }
  const Scene roofs(airborne("roofs", {}));
  std::set<std::uint32_t> labels;
  std::map<int, std::size_t> classes;
  for (const auto& p : all_points(roofs)) {
    labels.insert(p.label);
    ++classes[p.classification];
    ASSERT_EQ(p.classification == kTreeClass, p.label == 0);
  }
  EXPECT_EQ(labels.size(), surfaces + 1);  // And none, of the trees.
  EXPECT_EQ(roofs.edges().size(), edges);
  EXPECT_EQ(classes.size(), 2U);
  EXPECT_GT(classes[kTreeClass], 1000U);
}

TEST(Roofs_Walls, StandOnTheGround) {
  const Scene scene(airborne("roofs", {{"walls", 1}, {"ground", 1}, {"tree", 0}}));
  for (const auto& p : all_points(scene)) ASSERT_GE(p.z, 0.0);
  std::size_t feet = 0;
  for (const TruthEdge& edge : scene.edges()) {
    if (edge.role != "foot" && edge.role != "footing") continue;
    ++feet;
    EXPECT_EQ(edge.kind, EdgeKind::kConcave);
    EXPECT_EQ(edge.a.z, 0.0);
  }
  EXPECT_EQ(feet, 12U);
}

TEST(Parapet_WithoutWalls, IsALevelRingOverAFloor) {
  std::set<double> heights;
  const Scene scene(airborne("parapet", {{"walls", 0}}));
  for (const auto& p : all_points(scene)) heights.insert(p.z);
  EXPECT_EQ(heights, (std::set<double>{0.0, 0.9}));
  for (const TruthEdge& edge : scene.edges()) EXPECT_EQ(edge.kind, EdgeKind::kBoundary);
}

TEST(Roofs_Ground, IsOneSurfaceBelowTheRoofs) {
  double highest = -1e9;
  std::set<std::uint32_t> labels;
  for (const auto& p : all_points(Scene(airborne("roofs", {{"ground", 1}, {"tree", 0}})))) {
    if (p.classification != kGroundClass) continue;
    labels.insert(p.label);
    highest = std::max(highest, p.z);
  }
  EXPECT_EQ(labels.size(), 1U);
  EXPECT_EQ(highest, 0.0);
  EXPECT_THROW(Scene(airborne("roofs", {{"eave", 1}})), ConfigError);
}

}  // namespace
}  // namespace arris::synth
