#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene_testing.h"
#include "synth/scene_builders.h"

namespace arris::synth {
namespace {

Vec3 station_of(const io::FreshPoint& p) {
  static const SceneModel model = build_town(resolve_options(find_scene("town"), {}), 0.01);
  return model.stations[p.point_source_id - 1U].position;
}

double range_of(const io::FreshPoint& p) {
  return norm(Vec3{p.x, p.y, p.z} - station_of(p));
}

TEST(Town_Edges, LieOnFaces) {
  const Scene scene(request_of("town", 1000));
  EXPECT_GT(scene.edges().size(), 500U);
  for (const TruthEdge& edge : scene.edges()) {
    for (int i = 0; i <= 4; ++i) {
      const Vec3 p = edge.point_at(i / 4.0);
      ASSERT_LT(scene.distance({p.x, p.y, p.z}), 1e-9) << edge.role;
    }
  }
}

TEST(Town_Houses, NoPoint_LiesInsideThem) {
  // The house at (8, 13), 14 x 9 m with a heading of 1 degree, walls of 6.2 m; windows are recessed by 0.15 m.
  for (const auto& p : all_points(Scene(request_of("town", 300000)))) {
    EXPECT_FALSE(std::abs(p.x - 8) < 6.6 && std::abs(p.y - 13) < 4.0 && p.z > 0.01 && p.z < 6.0);
  }
}

TEST(Town_Occlusion, GroundBehindTheLongWall_IsNotSeen) {
  // The concrete wall at (-16, 6.5) is 1.8 m tall, taller than the scanner at (-14, 0.5) stands: it hides the ground
  // behind it from that one.
  for (const auto& p : all_points(Scene(request_of("town", 300000)))) {
    if (p.point_source_id != 1) continue;
    EXPECT_FALSE(std::abs(p.x + 16.3) < 1.5 && p.y > 6.8 && p.y < 8.5 && p.z < 0.1) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(Town_Density, OnTheGround_IsThatOfTheSphericalGrid) {
  constexpr double kHeight = 1.7, kHalfAngle = 0.15;
  const Scene scene(request_of("town", 1000000));
  const auto points = all_points(scene);
  const double step = scene.spacing() / 10.0;
  for (const auto& [from, to] : {std::pair{3.0, 5.0}, std::pair{6.0, 10.0}, std::pair{10.0, 16.0}}) {
    // The open sector towards +x along the street from station 2 at (13, -1).
    const auto count = std::count_if(points.begin(), points.end(), [&](const io::FreshPoint& p) {
      const double dx = p.x - 13, dy = p.y + 1, range = std::hypot(dx, dy);
      return p.point_source_id == 2 && p.z < 1e-6 && range > from && range < to &&
             std::abs(std::atan2(dy, dx)) < kHalfAngle;
    });
    const double rows = (std::atan(to / kHeight) - std::atan(from / kHeight)) / step, columns = 2 * kHalfAngle / step;
    EXPECT_NEAR(static_cast<double>(count), rows * columns, 0.5 * (rows + columns)) << from;
  }
}

TEST(Town_Intensity, FallsWithRangeOnTheGround) {
  std::vector<double> near, far;
  for (const auto& p : all_points(Scene(request_of("town", 200000)))) {
    if (p.z > 1e-6) continue;
    const double range = range_of(p);
    if (range < 4) near.push_back(p.intensity);
    if (range > 20) far.push_back(p.intensity);
  }
  ASSERT_FALSE(far.empty());
  EXPECT_GT(mean(near), 4 * mean(far));
}

TEST(Town_Noise, IsAlongTheRay) {
  SceneRequest request = request_of("town", 100000);
  const auto clean = all_points(Scene(request));
  request.noise = 0.004;
  const auto noisy = all_points(Scene(request));
  ASSERT_EQ(clean.size(), noisy.size());
  std::vector<double> along;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    const Vec3 from = station_of(clean[i]);
    const Vec3 ray = normalized(Vec3{clean[i].x, clean[i].y, clean[i].z} - from);
    const Vec3 move = Vec3{noisy[i].x - clean[i].x, noisy[i].y - clean[i].y, noisy[i].z - clean[i].z};
    along.push_back(dot(move, ray));
    ASSERT_LT(norm(move - along.back() * ray), 1e-9);
  }
  EXPECT_NEAR(mean(along), 0.0, 1e-4);
  EXPECT_NEAR(standard_deviation(along), 0.004, 1e-4);
}

TEST(Town_MixedPixels, LieOffTheSurfacesOnlyIfAskedFor) {
  SceneRequest request = request_of("town", 20000);
  const auto share_off = [&] {
    const Scene scene(request);
    const auto points = all_points(scene);
    const auto off = std::count_if(points.begin(), points.end(), [&](const io::FreshPoint& p) {
      return scene.distance({p.x, p.y, p.z}) > 0.01;
    });
    return static_cast<double>(off) / static_cast<double>(points.size());
  };
  EXPECT_EQ(share_off(), 0.0);
  request.options["mixed_pixels"] = 0.5;
  EXPECT_GT(share_off(), 0.001);
  EXPECT_LT(share_off(), 0.05);
}

TEST(Town_Registration, ShiftsEachStationAsAWhole) {
  SceneRequest request = request_of("town", 20000);
  const auto clean = all_points(Scene(request));
  request.options["registration"] = 0.005;
  const auto moved = all_points(Scene(request));
  ASSERT_EQ(clean.size(), moved.size());
  std::map<int, Vec3> shifts;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    const Vec3 shift{moved[i].x - clean[i].x, moved[i].y - clean[i].y, moved[i].z - clean[i].z};
    const auto [found, first] = shifts.emplace(clean[i].point_source_id, shift);
    ASSERT_LT(norm(found->second - shift), 1e-12);
    ASSERT_GT(norm(shift), 0.0);
  }
  EXPECT_EQ(shifts.size(), 4U);
}

TEST(Town_Spacing, IsTheDistanceOfRaysAtTenMetres) {
  SceneRequest request = request_of("town");
  request.spacing = 0.05;
  const Scene scene(request);
  const auto points = all_points(scene);
  // Neighbours in one column of the scan: smallest angle between consecutive rays.
  double least = 1e9;
  for (std::size_t i = 1; i < 5000; ++i) {
    const Vec3 a = normalized(Vec3{points[i - 1].x, points[i - 1].y, points[i - 1].z} - station_of(points[i - 1]));
    const Vec3 b = normalized(Vec3{points[i].x, points[i].y, points[i].z} - station_of(points[i]));
    least = std::min(least, norm(a - b));
  }
  EXPECT_NEAR(10.0 * least, 0.05, 0.0005);
}

}  // namespace
}  // namespace arris::synth
