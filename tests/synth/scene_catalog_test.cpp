#include "synth/scene_catalog.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/error.h"
#include "scene_testing.h"

namespace arris::synth {
namespace {

TEST(SceneCatalog_List, EveryScene_HasANameADescriptionAndValidDefaults) {
  std::set<std::string> names;
  for (const SceneInfo& scene : list_scenes()) {
    EXPECT_TRUE(names.insert(scene.name).second);
    EXPECT_FALSE(scene.description.empty());
    EXPECT_GT(scene.spacing, 0.0);
    EXPECT_NO_THROW(resolve_options(scene, {}));
    EXPECT_EQ(&find_scene(scene.name), &scene);
  }
  for (const char* name :
       {"block", "plates", "stairs", "gable", "hip", "dihedral", "plane", "sphere", "noise", "town"}) {
    EXPECT_EQ(names.count(name), 1U) << name;
  }
}

TEST(SceneRequest_Unknown, SceneSamplingOrOption_IsNamed) {
  const auto complaint = [](const SceneRequest& request) -> std::string {
    try {
      const Scene scene(request);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(complaint(request_of("blok")).find("blok"), std::string::npos);
  SceneRequest request = request_of("block");
  request.sampling = "hexagonal";
  EXPECT_NE(complaint(request).find("hexagonal"), std::string::npos);
  request = request_of("block");
  request.options["gap"] = 1;
  EXPECT_NE(complaint(request).find("gap"), std::string::npos);
  request = request_of("plates");
  request.options["gap_spacings"] = -1;
  EXPECT_NE(complaint(request).find("gap_spacings"), std::string::npos);
}

TEST(SceneRequest_OutOfRange, IsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<SceneRequest> bad(9, request_of("block"));
  bad[0].spacing = -1.0;
  bad[1].spacing = nan;
  bad[2].noise = -0.1;
  bad[3].noise = nan;
  bad[4].outliers = 1.0;
  bad[5].shift[1] = nan;
  bad[6].points = 10;
  bad[6].spacing = 1.0;
  bad[7].spacing = 1e-200;
  bad[8] = request_of("town");
  bad[8].spacing = 1e-9;
  for (std::size_t i = 0; i < bad.size(); ++i) EXPECT_THROW(Scene{bad[i]}, ConfigError) << i;
}

}  // namespace
}  // namespace arris::synth
