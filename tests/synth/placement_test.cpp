#include "synth/placement.h"

#include <gtest/gtest.h>

#include "scene_testing.h"

namespace arris::synth {
namespace {

TEST(Placement_Rotation, AnySeed_KeepsLengthsAndHandedness) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Placement placement(true, {0, 0, 0}, seed);
    const Vec3 x = placement.apply(Vec3{1, 0, 0}), y = placement.apply(Vec3{0, 1, 0}),
               z = placement.apply(Vec3{0, 0, 1});
    EXPECT_NEAR(norm(x), 1.0, 1e-14);
    EXPECT_NEAR(dot(x, y), 0.0, 1e-14);
    EXPECT_NEAR(norm(cross(x, y) - z), 0.0, 1e-14);
    const Vec3 p{1.5, -2.5, 3.5};
    EXPECT_NEAR(norm(placement.undo(placement.apply(p)) - p), 0.0, 1e-14);
  }
}

TEST(Placement_Scene, RotatedAndShifted_IsTheSameSceneElsewhere) {
  for (const char* name : {"block", "plates", "hip", "town"}) {
    SceneRequest request = request_of(name, 3000);
    const Scene plain(request);
    request.rotate = true;
    request.shift = {500000.0, 5000000.0, 100.0};
    request.seed = 1;
    const Scene moved(request);
    const Placement placement(true, {500000.0, 5000000.0, 100.0}, 1);

    const auto before = all_points(plain), after = all_points(moved);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Vec3 expected = placement.apply(Vec3{before[i].x, before[i].y, before[i].z});
      ASSERT_NEAR(norm(expected - Vec3{after[i].x, after[i].y, after[i].z}), 0.0, 1e-8);
    }
    ASSERT_EQ(plain.edges().size(), moved.edges().size());
    for (std::size_t i = 0; i < plain.edges().size(); ++i) {
      const TruthEdge &a = plain.edges()[i], &b = moved.edges()[i];
      for (const double t : {0.0, 0.3, 1.0})
        ASSERT_NEAR(norm(placement.apply(a.point_at(t)) - b.point_at(t)), 0.0, 1e-8);
      ASSERT_EQ(a.angle_deg, b.angle_deg);
    }
    const auto bounds = moved.bounds();
    for (const auto& p : after) {
      ASSERT_GE(p.x, bounds[0][0] - 1e-6);
      ASSERT_LE(p.y, bounds[1][1] + 1e-6);
    }
  }
}

}  // namespace
}  // namespace arris::synth
