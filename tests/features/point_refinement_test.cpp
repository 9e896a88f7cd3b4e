#include "features/supervoxel/point_refinement.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

namespace arris {
namespace {

constexpr std::int32_t kVoxel = 100;
constexpr double kFractions = 16.0 * kVoxel;  // Of a voxel.

VoxelPosition at(double x, double y, double z) {  // In voxels.
  const auto fractions = [](double v) { return static_cast<std::uint32_t>(std::lround(v * kFractions)); };
  return {fractions(x), fractions(y), fractions(z)};
}
ClusterPlane plane(const VoxelPosition& position, double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return {position, {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)}};
}
ClusterPlane tilted(double degrees) {
  const double angle = degrees * 3.14159265358979323846 / 180.0;
  return plane(at(0, 0, 0), std::sin(angle), 0, std::cos(angle));
}

TEST(PlanesDiffer, ByMoreThanTenDegreesOrAQuarterOfAVoxel) {
  const ClusterPlane floor = plane(at(0, 0, 0), 0, 0, 1);
  EXPECT_FALSE(planes_differ(floor, floor, kVoxel));
  EXPECT_FALSE(planes_differ(floor, tilted(9.5), kVoxel));
  EXPECT_TRUE(planes_differ(floor, tilted(10.5), kVoxel));
  EXPECT_FALSE(planes_differ(floor, plane(at(5, 5, 0.2), 0, 0, -1), kVoxel)) << "signs have no meaning";
  EXPECT_TRUE(planes_differ(floor, plane(at(5, 5, 0.3), 0, 0, 1), kVoxel));
  const ClusterPlane leaning = plane(at(8, 0, 0), std::sin(0.1), 0, std::cos(0.1));
  EXPECT_TRUE(planes_differ(floor, leaning, kVoxel))
      << "the floor lies 0.8 voxels from it, though not it from the floor";
  EXPECT_TRUE(planes_differ(leaning, floor, kVoxel));
  EXPECT_FALSE(planes_differ(floor, ClusterPlane{}, kVoxel));
  EXPECT_FALSE(planes_differ(ClusterPlane{at(9, 9, 9), {}}, floor, kVoxel));
}

TEST(RefinedLabel, PointBesideAFold_GoesToTheFaceItLiesOn) {
  const std::vector<ClusterPlane> planes{{}, plane(at(5, 0, 0), 0, 0, 1), plane(at(0, 0, 5), 1, 0, 0)};
  const std::vector<std::uint32_t> wall{2};
  const std::vector<std::uint32_t> floor{1};
  EXPECT_EQ(refined_label(planes, 1, wall, at(0.0, 3, 0.4), kVoxel), 2U);
  EXPECT_EQ(refined_label(planes, 2, floor, at(0.4, 3, 0.0), kVoxel), 1U);
  EXPECT_EQ(refined_label(planes, 1, wall, at(0.4, 3, 0.0), kVoxel), 1U);
  EXPECT_EQ(refined_label(planes, 1, wall, at(0.0, 3, 0.1), kVoxel), 1U) << "nearer, but not by an eighth of a voxel";
}

TEST(RefinedLabel, SupervoxelsWithoutPlane_NeitherWinNorLose) {
  const std::vector<ClusterPlane> planes{
      {}, {at(0, 0, 0), {}}, plane(at(0, 0, 0), 0, 0, 1), plane(at(0, 0, 2), 0, 0, 1)};
  const std::vector<std::uint32_t> others{2};
  EXPECT_EQ(refined_label(planes, 1, others, at(0, 0, 0), kVoxel), 1U);
  const std::vector<std::uint32_t> none{1};
  EXPECT_EQ(refined_label(planes, 3, none, at(0, 0, 0), kVoxel), 3U);
}

// Nearest plane by the definition, over small offsets so that ties are frequent.
RC_GTEST_PROP(RefinedLabel, AnyPlanes_IsTheNearestByTheMarginWithTheSmallerIdOnTies, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("seed"));
  std::vector<ClusterPlane> planes{{}};
  for (int i = 0; i < 8; ++i) {
    ClusterPlane p{{}, {}};
    for (std::uint32_t& c : p.position) c = static_cast<std::uint32_t>(random() % 7) * 100U;
    if (random() % 4 != 0) p.normal[random() % 3] = 1.0F;
    planes.push_back(p);
  }
  VoxelPosition point;
  for (std::uint32_t& c : point) c = static_cast<std::uint32_t>(random() % 7) * 100U;
  const std::uint32_t own = 1 + static_cast<std::uint32_t>(random() % 8);
  std::vector<std::uint32_t> others;
  for (std::uint32_t id = 8; id >= 1; --id) {
    if (id != own && random() % 2) others.push_back(id);
  }
  const auto distance = [&](std::uint32_t id) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      sum += difference(point[i], planes[id].position[i]) * double{planes[id].normal[i]};
    return std::abs(sum);
  };
  std::pair<double, std::uint32_t> best{1e30, 0};
  for (const std::uint32_t id : others) {
    if (planes[id].normal != std::array<float, 3>{}) best = std::min(best, {distance(id), id});
  }
  const bool moves = best.first < distance(own) - kFractions / 8.0;
  RC_ASSERT(refined_label(planes, own, others, point, kVoxel) == (moves ? best.second : own));
}

}  // namespace
}  // namespace arris
