#include "synth/ray_caster.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene_testing.h"
#include "synth/counter_random.h"
#include "synth/scene_builders.h"

namespace arris::synth {
namespace {

SceneModel town() {
  return build_town(resolve_options(find_scene("town"), {}), 0.01);
}

/// Range of the first face along a ray by sphere tracing: steps as long as the distance to the nearest face pass
/// through none. Knows nothing of intersections. 0 if it leaves the scene or creeps along a face.
double traced_range(const SceneModel& model, const Vec3& from, const Vec3& direction) {
  double range = 0.0;
  for (int step = 0; step < 400 && range < 120.0; ++step) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Face& face : model.faces) nearest = std::min(nearest, face.distance(from + range * direction));
    if (nearest < 1e-7) return range;
    range += nearest;
  }
  return 0.0;
}

TEST(RayCaster_Culling, ManyRays_AgreesWithTestingEveryFace) {
  const SceneModel model = town();
  PointRandom random(1);
  for (const Vec3& position :
       {model.stations[0].position, model.stations[3].position, Vec3{3, 2, 0.2}, Vec3{-10, 14, 30}}) {
    const RayCaster caster(model, position, 120.0);
    RayCaster::Column column;
    for (int i = 0; i < 300; ++i) {
      const SinCos azimuth = sin_cos_turns(random.uniform());
      caster.start_column(column, azimuth.sin, azimuth.cos);
      for (int j = 0; j < 60; ++j) {
        const SinCos elevation = sin_cos_turns(0.5 * random.uniform() - 0.25);
        ASSERT_EQ(caster.cast(column, elevation.sin, elevation.cos),
                  caster.cast_all(column, elevation.sin, elevation.cos));
      }
    }
  }
}

TEST(RayCaster_NearestHit, SphereTracing_FindsTheSameRange) {
  const SceneModel model = town();
  const Vec3 position = model.stations[0].position;
  const RayCaster caster(model, position, 120.0);
  RayCaster::Column column;
  PointRandom random(2);
  int compared = 0;
  for (int i = 0; i < 250; ++i) {
    const SinCos azimuth = sin_cos_turns(random.uniform()), elevation = sin_cos_turns(0.2 * random.uniform() - 0.1);
    caster.start_column(column, azimuth.sin, azimuth.cos);
    const RayHit hit = caster.cast(column, elevation.sin, elevation.cos);
    const Vec3 direction{elevation.cos * azimuth.cos, elevation.cos * azimuth.sin, elevation.sin};
    const double traced = traced_range(model, position, direction);
    if (traced == 0.0 || hit.cosine < 0.01) continue;
    ++compared;
    EXPECT_NEAR(hit.range, traced, 1e-7 / hit.cosine + 1e-7) << "ray " << i;
  }
  EXPECT_GT(compared, 150);
}

TEST(RayCaster_Wall, HeadOnAndOblique_AreAnalytic) {
  SceneModel model;
  model.rectangle({5, -100, -100}, {5, 100, -100}, {5, -100, 100}, Material{});
  const RayCaster caster(model, {0, 0, 0}, 50.0);
  RayCaster::Column column;
  caster.start_column(column, 0.0, 1.0);
  EXPECT_DOUBLE_EQ(caster.cast(column, 0.0, 1.0).range, 5.0);
  EXPECT_DOUBLE_EQ(caster.cast(column, 0.6, 0.8).range, 6.25);
  EXPECT_DOUBLE_EQ(caster.cast(column, 0.6, 0.8).cosine, 0.8);
  caster.start_column(column, 0.0, -1.0);
  EXPECT_EQ(caster.cast(column, 0.0, 1.0).range, 0.0);
}

}  // namespace
}  // namespace arris::synth
