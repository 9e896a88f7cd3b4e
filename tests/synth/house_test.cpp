#include "synth/house.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/error.h"
#include "scene_testing.h"

namespace arris::synth {
namespace {

/// Total length per "kind role".
std::map<std::string, double> lengths(const std::vector<TruthEdge>& edges) {
  std::map<std::string, double> result;
  for (const TruthEdge& edge : edges) result[std::string(name(edge.kind)) + " " + edge.role] += edge.length();
  return result;
}

TEST(House_GableRoof, SeenFromTheAir_HasRidgeEavesAndGables) {
  SceneRequest request = request_of("gable");
  request.options = {{"length", 12}, {"width", 8}, {"pitch", 45}};
  const auto found = lengths(Scene(request).edges());
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found.at("convex ridge"), 12.0, 1e-12);
  EXPECT_NEAR(found.at("boundary eave"), 24.0, 1e-12);
  EXPECT_NEAR(found.at("boundary gable"), 4 * 4 * std::numbers::sqrt2, 1e-12);
}

TEST(House_HipRoof, SeenFromTheAir_HasFourHipsOfKnownLengthAndAngle) {
  SceneRequest request = request_of("hip");
  request.options = {{"length", 12}, {"width", 8}, {"pitch", 45}};
  const Scene scene(request);
  const auto found = lengths(scene.edges());
  EXPECT_NEAR(found.at("convex ridge"), 4.0, 1e-12);
  EXPECT_NEAR(found.at("convex hip"), 4 * std::sqrt(4.0 * 4 + 4 * 4 + 4 * 4), 1e-12);
  EXPECT_NEAR(found.at("boundary eave"), 40.0, 1e-12);
  for (const TruthEdge& edge : scene.edges()) {
    // At hips the normals (1, 0, 1) and (0, 1, 1) are 60 degrees apart.
    if (edge.kind == EdgeKind::kConvex) {
      EXPECT_NEAR(edge.angle_deg, edge.role == "hip" ? 120.0 : 90.0, 1e-9);
    }
  }
}

TEST(House_Walls, WithoutOverhang_TurnEavesIntoFolds) {
  SceneRequest request = request_of("gable");
  request.options = {{"length", 12}, {"width", 8}, {"pitch", 30}, {"eave", 5}, {"walls", 1}, {"ground", 1}};
  const auto found = lengths(Scene(request).edges());
  EXPECT_NEAR(found.at("convex eave"), 24.0, 1e-12);
  EXPECT_NEAR(found.at("convex wall_corner"), 20.0, 1e-12);
  EXPECT_NEAR(found.at("concave footing"), 40.0, 1e-12);
  EXPECT_NEAR(found.at("boundary ground_border"), 2 * (22.0 + 18.0), 1e-12);
  EXPECT_EQ(found.count("boundary eave"), 0U);
}

TEST(House_Overhang, EavesAreFreeAndWallsMeetTheRoofFromBelow) {
  for (const char* roof : {"gable", "hip"}) {
    SceneRequest request = request_of(roof);
    request.options = {{"length", 12}, {"width", 8}, {"walls", 1}, {"overhang", 0.5}};
    const auto found = lengths(Scene(request).edges());
    EXPECT_GT(found.at("boundary eave"), 24.0) << roof;
    EXPECT_GE(found.at("concave soffit"), 24.0) << roof;
    EXPECT_NEAR(found.at("boundary footing"), 40.0, 1e-12) << roof;
  }
}

TEST(House_ImpossibleRoofs, AreRefused) {
  SceneRequest request = request_of("hip");
  request.options = {{"length", 5}, {"width", 8}};
  EXPECT_THROW(Scene{request}, ConfigError);
  request.options = {{"pitch", 80}, {"overhang", 2}, {"eave", 3}};
  EXPECT_THROW(Scene{request}, ConfigError);
}

TEST(House_SquareHipRoof, IsAPyramidWithoutRidge) {
  SceneRequest request = request_of("hip", 5000);
  request.options = {{"length", 8}, {"width", 8}};
  const Scene scene(request);
  EXPECT_EQ(lengths(scene.edges()).count("convex ridge"), 0U);
  for (const auto& p : all_points(scene)) ASSERT_LT(scene.distance({p.x, p.y, p.z}), 1e-9);
}

}  // namespace
}  // namespace arris::synth
