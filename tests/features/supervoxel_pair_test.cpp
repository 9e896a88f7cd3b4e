// How supervoxels lie to each other, on planes and cylinders; frames and mutual nearest neighbours.

#include "features/zheng/supervoxel_pair.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ball_testing.h"
#include "features/numerics/exact_math.h"
#include "features/zheng/mutual_nearest.h"
#include "features/zheng/supervoxel_frame.h"
#include "random_clouds.h"

namespace arris {
namespace {

/// Labels 1 and 2.
SupervoxelTable table_with(const Vector3& n1, const Vector3& c1, const Vector3& n2, const Vector3& c2) {
  SupervoxelTable table;
  table.normal = {{0.0F, 0.0F, 0.0F}};
  for (const Vector3& n : {n1, n2}) {
    table.normal.push_back({static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
  }
  table.centroid = {{0.0, 0.0, 0.0}, c1, c2};
  table.spacing = table.thickness = {0.0F, 1.0F, 1.0F};
  return table;
}

TEST(SupervoxelPair, HalfPlanes_HaveTheirInteriorAngle) {
  for (int deg = 5; deg < 180; deg += 5) {
    const double angle = deg / kDegreesPerRadian;
    for (const double sign : {-1.0, 1.0}) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const test::Rotation r = test::any_rotation(seed);
        // One half plane along +x, the other turned by `angle` about the y axis.
        const Vector3 away{std::cos(angle), 0.0, std::sin(angle)};
        const SupervoxelTable table = table_with(test::rotated(r, {0.0, 0.0, sign}), test::rotated(r, {10.0, 3.0, 0.2}),
                                                 test::rotated(r, {-away[2], 0.0, away[0]}),
                                                 test::rotated(r, {10.0 * away[0], -2.0, 10.0 * away[2]}));
        const Vector3 contact = test::rotated(r, {0.3, 1.0, 0.1});
        EXPECT_NEAR(interior_angle_deg(table, 1, 2, contact), deg, 1e-4);
        EXPECT_NEAR(interior_angle_deg(table, 2, 1, contact), deg, 1e-4);
        EXPECT_NEAR(normal_angle_deg(table, 1, 2), std::min(deg, 180 - deg), 1e-4);
      }
    }
  }
}

TEST(SupervoxelPair, UndefinedNormals_AreNoFoldAndNoStep) {
  const SupervoxelTable table = table_with({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {5.0, 0.0, 9.0});
  EXPECT_EQ(normal_angle_deg(table, 1, 2), 0.0);
  EXPECT_EQ(step_height(table, 1, 2), 0.0);
  EXPECT_EQ(interior_angle_deg(table, 1, 2, {1.0, 0.0, 0.0}), 180.0);
  EXPECT_FALSE(supervoxel_frame(table, 1).defined);
}

TEST(SupervoxelPair, ParallelPlanes_HaveTheirStepWhateverTheSigns) {
  for (const double sign : {-1.0, 1.0}) {
    const SupervoxelTable table = table_with({0.0, 0.0, sign}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {40.0, 7.0, -3.0});
    EXPECT_NEAR(step_height(table, 1, 2), 3.0, 1e-12);
    EXPECT_NEAR(step_height(table, 2, 1), 3.0, 1e-12);
  }
}

TEST(SupervoxelPair, NeighboursOnACylinder_HaveNoStep) {
  const double half = 10.0 / kDegreesPerRadian;
  const SupervoxelTable table =
      table_with({std::sin(half), 0.0, std::cos(half)}, {100.0 * std::sin(half), 0.0, 100.0 * std::cos(half)},
                 {std::sin(half), 0.0, -std::cos(half)}, {-100.0 * std::sin(half), 0.0, 100.0 * std::cos(half)});
  EXPECT_NEAR(step_height(table, 1, 2), 0.0, 1e-5);
  EXPECT_NEAR(normal_angle_deg(table, 1, 2), 20.0, 1e-5);
}

TEST(SupervoxelFrame, Coordinates_AreExactWhateverTheOrigin) {
  test::Random random(3);
  for (int i = 0; i < 300; ++i) {
    const test::Rotation r = test::any_rotation(static_cast<std::uint64_t>(i));
    const SupervoxelTable table = table_with(r[0], {0, 0, 0}, r[1], {0, 0, 0});
    const SupervoxelFrame f = supervoxel_frame(table, 1);
    ASSERT_TRUE(f.defined);
    EXPECT_NEAR(dot(f.u, f.v), 0.0, 1e-5);
    EXPECT_NEAR(dot(f.u, f.n), 0.0, 1e-5);
    EXPECT_NEAR(dot(f.v, f.n), 0.0, 1e-5);
    for (const Vector3& e : {f.u, f.v, f.n}) EXPECT_NEAR(dot(e, e), 1.0, 1e-4);
    Vector3 p, q, d;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p[axis] = std::floor(random.in(-2147483648.0, 2147483648.0));
      q[axis] = std::floor(random.in(-2147483648.0, 2147483648.0));
      d[axis] = q[axis] - p[axis];
    }
    for (const Vector3& e : {f.u, f.v, f.n}) EXPECT_EQ(dot(e, q) - dot(e, p), dot(e, d));
  }
}

TEST(MutualNearest, AnyCloud_AgreesWithBruteForce) {
  for (const test::Shape shape : {test::Shape::kVolume, test::Shape::kGrid, test::Shape::kGridFold}) {
    const TilePoints tile = test::tile_of(test::random_positions(shape, 300, 100.0, 4), 4);
    const PointTree tree(tile.positions, tile.ids);
    std::vector<std::uint32_t> labels(tree.size());
    for (std::size_t slot = 0; slot < labels.size(); ++slot) {
      labels[slot] = 1U + static_cast<std::uint32_t>(tree.x()[slot] + tree.y()[slot]) % 2U;
    }
    LabelledGroup group;
    group.gather(tree, labels, {{-200, -200, -200}, {200, 200, 200}}, 1.0);
    ASSERT_EQ(group.parts().size(), 2U);
    const auto nearest = [&](std::size_t from, std::uint32_t label) {
      std::size_t best = labels.size();
      for (std::size_t slot = 0; slot < labels.size(); ++slot) {
        if (labels[slot] != label) continue;
        const auto key = [&](std::size_t s) {
          return std::pair(squared_distance(tree.position(s), tree.position(from)), tree.id(s));
        };
        if (best == labels.size() || key(slot) < key(best)) best = slot;
      }
      return best;
    };
    int pairs = 0;
    for (std::uint32_t slot = 0; slot < labels.size(); ++slot) {
      const std::uint32_t other = 3 - labels[slot];
      const std::size_t there = nearest(slot, other);
      const NearestPoint found =
          mutual_nearest(tree, group, slot, *group.part(labels[slot]), *group.part(other), 100.0);
      const auto d2 = static_cast<double>(squared_distance(tree.position(slot), tree.position(there)));
      const bool expected = d2 <= 100.0 && nearest(there, labels[slot]) == slot;
      ASSERT_EQ(std::isfinite(found.d2), expected);
      if (!expected) continue;
      EXPECT_EQ(group.slot(found.index), there);
      EXPECT_EQ(found.d2, d2);
      ++pairs;
    }
    EXPECT_GT(pairs, 10);
  }
}

}  // namespace
}  // namespace arris
