#include "synth/surface_numbers.h"

#include <gtest/gtest.h>

#include <set>

#include "scene_testing.h"
#include "synth/scene_builders.h"

namespace arris::synth {
namespace {

std::vector<std::uint32_t> numbers_of(SceneModel& model) {
  number_surfaces(model.faces);
  std::vector<std::uint32_t> numbers;
  for (const Face& face : model.faces) numbers.push_back(face.surface);
  return numbers;
}

using Numbers = std::vector<std::uint32_t>;

SceneModel model_of(const std::string& scene) {
  const SceneInfo& info = find_scene(scene);
  return info.build(resolve_options(info, {}), info.spacing);
}

TEST(SurfaceNumbers_Planes, PartsThatShareAPieceOfASide_AreOne) {
  SceneModel model;
  model.rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {});
  model.rectangle({2, 1, 0}, {5, 1, 0}, {2, 4, 0}, {});   // Shares (2, 1) to (2, 2).
  model.rectangle({2, 0, 0}, {2, 0, -3}, {2, 2, 0}, {});  // The same line, but another plane.
  model.rectangle({9, 4, 0}, {9, 2, 0}, {5, 4, 0}, {});   // Touches the second only; its normal points down.
  EXPECT_EQ(numbers_of(model), (Numbers{1, 1, 2, 1}));
}

TEST(SurfaceNumbers_Planes, ThatAreApartOrShareACornerOnly_StayApart) {
  SceneModel model;
  model.rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {});
  model.rectangle({2, 2, 0}, {4, 2, 0}, {2, 4, 0}, {});              // A common corner.
  model.rectangle({0, 2.001, 0}, {1, 2.001, 0}, {0, 3, 0}, {});      // A slit.
  model.rectangle({2, 0, 0.001}, {4, 0, 0.001}, {2, 1, 0.001}, {});  // A step.
  EXPECT_EQ(numbers_of(model), (Numbers{1, 2, 3, 4}));
}

TEST(SurfaceNumbers_Planes, AFilledHole_IsOneWithItsPlane) {
  SceneModel model;
  model.rectangle({0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {}).circle_holes = {{{4, 4}, 1.5}};
  model.faces.back().rect_holes = {{{0.5, 0.5}, {1.5, 1.5}}};
  model.disc({4, 4, 0}, {0, 0, 1}, 1.0, {});
  model.disc({4, 4, 0}, {0, 0, 1}, 1.5, {});
  model.rectangle({0.5, 0.5, 0}, {1.5, 0.5, 0}, {0.5, 1.5, 0}, {});
  // The small disc is a part of the large one.
  EXPECT_EQ(numbers_of(model), (Numbers{1, 1, 1, 1}));
  model.faces.erase(model.faces.begin() + 2);
  EXPECT_EQ(numbers_of(model), (Numbers{1, 2, 1}));
}

TEST(SurfaceNumbers_Cylinders, HalvesOfOne_AreOne) {
  SceneModel model;
  model.cylinder_part({0, 0, 0}, {0, 0, 3}, {1, 0, 0}, 0.5, {});
  model.cylinder_part({0, 0, 0}, {0, 0, 3}, {-1, 0, 0}, 0.5, {});
  model.cylinder({0, 0, 3}, {0, 0, 1}, 2.0, 1.0, {});  // Stands on both.
  model.cylinder({0, 0, 5}, {0, 0, 1}, 2.0, 0.9, {});  // Another radius.
  model.cylinder({0, 0, 8}, {0, 0, 1}, 2.0, 1.0, {});  // In the air.
  model.disc({0, 0, 5}, {0, 0, 1}, 1.0, {});
  EXPECT_EQ(numbers_of(model), (Numbers{1, 1, 1, 2, 3, 4}));
}

TEST(SurfaceNumbers_Scenes, HaveAsManySurfacesAsTheirDescriptionSays) {
  const auto surfaces_of = [](const std::string& scene) {
    SceneModel model = model_of(scene);
    const Numbers numbers = numbers_of(model);
    return std::set<std::uint32_t>(numbers.begin(), numbers.end()).size();
  };
  EXPECT_EQ(surfaces_of("block"), 10U);   // 4 walls, 2 levels with a hole, 2 cylinders, 2 discs.
  EXPECT_EQ(surfaces_of("stairs"), 20U);  // 10 treads, 10 risers.
  EXPECT_EQ(surfaces_of("dormer"), 7U);   // 8 polygons; the slope with the dormer is cut in two.
  // Per letter: front and back, twice an outside and an inside, two ends; three steps of 4 sides and a level, three
  // posts of 4 sides and a top, and the disc.
  EXPECT_EQ(surfaces_of("sculpture"), 3U * (2 + 4 + 2) + 3 * 5 + 3 * 5 + 1);
}

TEST(SurfaceNumbers_Volume, IsNoSurface) {
  SceneModel model = model_of("noise");
  EXPECT_EQ(numbers_of(model), Numbers{0});
  for (const auto& p : all_points(Scene(request_of("noise", 1000)))) ASSERT_EQ(p.label, 0U);
}

TEST(SceneLabels_OfPoints, NameASurfaceThatTheyLieOn) {
  for (const char* scene : {"block", "dormer", "sculpture", "town"}) {
    SceneModel model = model_of(scene);
    number_surfaces(model.faces);
    std::map<std::uint32_t, std::vector<const Face*>> faces;
    for (const Face& face : model.faces) faces[face.surface].push_back(&face);
    for (const auto& p : all_points(Scene(request_of(scene, 20000)))) {
      double nearest = 1e9;
      for (const Face* face : faces[p.label]) nearest = std::min(nearest, face->distance({p.x, p.y, p.z}));
      ASSERT_LT(nearest, 1e-9) << scene;
    }
  }
}

TEST(SceneLabels_OfStrayPoints, AreZero) {
  for (const char* scene : {"block", "town"}) {
    SceneRequest request = request_of(scene, 20000);
    request.outliers = 0.1;
    if (request.scene == "town") request.options["mixed_pixels"] = 0.5;
    std::size_t stray = 0;
    for (const auto& p : all_points(Scene(request))) {
      ASSERT_EQ(p.label == 0, p.classification == 7) << scene;
      if (p.label == 0) ++stray;
    }
    EXPECT_GT(stray, 1000U);
  }
}

}  // namespace
}  // namespace arris::synth
