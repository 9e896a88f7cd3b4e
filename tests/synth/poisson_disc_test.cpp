#include "synth/poisson_disc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "evaluate/box_tree.h"
#include "scene_testing.h"

namespace arris::synth {
namespace {

using evaluate::Box3;
using evaluate::Vec3;

SceneRequest poisson(const std::string& scene, std::uint64_t points) {
  SceneRequest request = request_of(scene, points);
  request.sampling = "poisson";
  return request;
}

/// Distance of each point to its nearest neighbour on the same face, by face, in spacings.
std::map<int, std::vector<double>> neighbour_distances(const Scene& scene) {
  std::map<int, std::vector<Vec3>> faces;
  for (const io::FreshPoint& p : all_points(scene)) faces[p.point_source_id].push_back({p.x, p.y, p.z});
  std::map<int, std::vector<double>> result;
  for (const auto& [face, points] : faces) {
    const evaluate::BoxTree tree(points.size(), [&](std::size_t i) { return Box3{points[i], points[i]}; });
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      double limit = std::numeric_limits<double>::infinity();
      tree.search(points[i], limit, [&](std::uint32_t j) {
        const Vec3 apart = points[j] - points[i];
        if (j != i) limit = std::min(limit, dot(apart, apart));
      });
      result[face].push_back(std::sqrt(limit) / scene.spacing());
    }
  }
  return result;
}

TEST(PoissonDisc_Distance, NoTwoPointsOfAFace_AreNearerThanTheLaw) {
  for (const std::string scene : {"block", "plates", "sphere", "hip", "stairs"}) {
    for (const auto& [face, distances] : neighbour_distances(Scene(poisson(scene, 20000)))) {
      EXPECT_GE(*std::min_element(distances.begin(), distances.end()), 0.72) << scene << " face " << face;
      // Dense: nearly every point has a neighbour within one and a half spacings.
      const auto lonely = std::count_if(distances.begin(), distances.end(), [](double d) { return d > 1.5; });
      EXPECT_LE(static_cast<double>(lonely), 0.002 * static_cast<double>(distances.size()) + 1)
          << scene << " face " << face;
    }
  }
}

TEST(PoissonDisc_Distance, NarrowCylindersAndSmallSpheres_KeepTheLawToo) {
  SceneRequest sphere = poisson("sphere", 0);
  for (const double radius : {0.3, 0.7, 1.5, 3.0}) {
    sphere.options["radius"] = radius;
    sphere.spacing = 1.0;
    for (const auto& [face, distances] : neighbour_distances(Scene(sphere))) {
      EXPECT_GE(*std::min_element(distances.begin(), distances.end()), 0.72) << radius;
    }
  }
}

TEST(PoissonDisc_Density, IsOnePointPerSpacingSquared) {
  SceneRequest request = poisson("plane", 0);
  request.options["size"] = 300.0;
  request.spacing = 1.0;
  EXPECT_NEAR(static_cast<double>(all_points(Scene(request)).size()) / 90000.0, 1.0, 0.005);
  // Up to the very border: the discs beyond it compete and are left out.
  std::size_t near_border = 0;
  for (const io::FreshPoint& p : all_points(Scene(request))) near_border += p.x < 2.0 || p.x > 298.0 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(near_border), 1200.0, 60.0);
}

TEST(PoissonDisc_Stream, AnyBlockSizeAndSeed_GiveTheSamePointsForTheSameRequest) {
  SceneRequest request = poisson("block", 15000);
  request.noise = 0.01;
  const auto whole = all_points(Scene(request), 10'000'000);
  for (const std::size_t block_points : {1, 777}) {
    const auto parts = all_points(Scene(request), block_points);
    ASSERT_EQ(parts.size(), whole.size());
    EXPECT_TRUE(std::equal(parts.begin(), parts.end(), whole.begin(), same));
  }
  request.seed = 2;
  const auto other = all_points(Scene(request));
  EXPECT_FALSE(other.size() == whole.size() && std::equal(other.begin(), other.end(), whole.begin(), same));
}

}  // namespace
}  // namespace arris::synth
