#include "features/supervoxel/voxel_normals.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "voxel_tile_testing.h"

namespace arris {
namespace {

using Vector = std::array<double, 3>;
constexpr std::int32_t kSide = 240;
constexpr double kDegrees = 180.0 / 3.14159265358979323846;

double dot(const Vector& a, const std::array<float, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double angle_deg(const Vector& truth, const std::array<float, 3>& normal) {
  return std::acos(std::min(1.0, std::abs(dot(truth, normal)))) * kDegrees;
}
Vector any_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vector v{normal(random), normal(random), normal(random)};
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (double& c : v) c /= length;
  return v;
}

struct Plane {
  Vector normal;
  VoxelTile tile;
  std::vector<bool> inner;  ///< At least four voxels from the border.
};

/// A disc of 12 voxels radius, four points per voxel side. @param noise  across the plane, voxel sides.
Plane plane_disc(const Vector& n, double noise, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> off(0.0, noise * kSide);
  const Vector axis = std::abs(n[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  Vector u{n[1] * axis[2] - n[2] * axis[1], n[2] * axis[0] - n[0] * axis[2], n[0] * axis[1] - n[1] * axis[0]};
  const double length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  for (double& c : u) c /= length;
  const Vector v{n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
  std::vector<LatticePoint> points;
  constexpr int kRadius = 48;
  for (int i = -kRadius; i <= kRadius; ++i) {
    for (int j = -kRadius; j <= kRadius; ++j) {
      if (i * i + j * j > kRadius * kRadius) continue;
      const double h = noise > 0.0 ? off(random) : 0.0;
      const auto at = [&](std::size_t c) {
        return static_cast<std::int32_t>(std::lround(kSide / 4.0 * (i * u[c] + j * v[c]) + h * n[c]));
      };
      points.push_back({at(0), at(1), at(2)});
    }
  }
  Plane plane{n, test::voxel_tile_of(kSide, points), {}};
  for (const LatticePoint& k : plane.tile.keys)
    plane.inner.push_back(std::sqrt(double(k.x) * k.x + double(k.y) * k.y + double(k.z) * k.z) < 8.0);
  return plane;
}

RC_GTEST_PROP(VoxelNormals, AnyPlane_HasItsNormalEverywhereWithOneSign, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("seed"));
  const Plane plane = plane_disc(any_direction(random), 0.0, 1);
  const auto normals = voxel_normals(plane.tile);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto& n = normals[i];
    RC_ASSERT(std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0F) < 1e-5F);
    if (plane.inner[i]) RC_ASSERT(angle_deg(plane.normal, n) < 0.1);
    RC_ASSERT(3.0F * n[0] + 4.0F * n[1] + 12.0F * n[2] > -1e-4F);
  }
}

RC_GTEST_PROP(VoxelNormals, NoisyPlane_IsWithinAFewDegrees, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("seed"));
  const Plane plane = plane_disc(any_direction(random), 0.1, random());
  const auto normals = voxel_normals(plane.tile);
  double sum = 0.0;
  int inner = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!plane.inner[i]) continue;
    sum += angle_deg(plane.normal, normals[i]);
    ++inner;
  }
  RC_ASSERT(inner > 100);
  RC_ASSERT(sum / inner < 3.0);
}

TEST(VoxelNormals, BesideTheFoldsOfABox_AreThoseOfTheirOwnFace) {
  // Faces run through the middles of voxels 0 and 20 of each axis.
  constexpr std::int32_t kVoxels = 20;
  std::vector<LatticePoint> points;
  constexpr std::int32_t kStep = kSide / 4;
  for (std::int32_t i = 0; i <= 4 * kVoxels; ++i) {
    for (std::int32_t j = 0; j <= 4 * kVoxels; ++j) {
      for (const std::int32_t end : {0, kVoxels * kSide}) {
        points.push_back({end, i * kStep, j * kStep});
        points.push_back({i * kStep, end, j * kStep});
        points.push_back({i * kStep, j * kStep, end});
      }
    }
  }
  const VoxelTile tile = test::voxel_tile_of(kSide, points);
  const auto normals = voxel_normals(tile);
  int beside = 0;
  for (std::size_t v = 0; v < tile.size(); ++v) {
    const LatticePoint& k = tile.keys[v];
    Vector face{};
    int faces = 0;
    bool near = false;
    for (int axis = 0; axis < 3; ++axis) {
      const bool on = k[axis] == 0 || k[axis] == kVoxels;
      faces += on;
      if (on) face[static_cast<std::size_t>(axis)] = 1.0;
      near = near || k[axis] == 1 || k[axis] == kVoxels - 1;
    }
    if (faces != 1) continue;
    beside += near;
    EXPECT_LT(angle_deg(face, normals[v]), 1.0) << k.x << " " << k.y << " " << k.z;
  }
  EXPECT_GT(beside, 400);
}

/// Treads and risers along y, a fold every `width` voxels.
VoxelTile staircase(std::int32_t width) {
  std::vector<LatticePoint> points;
  constexpr std::int32_t kStep = kSide / 4;
  const std::int32_t rise = width * kSide;
  for (std::int32_t step = 0; step < 8; ++step) {
    for (std::int32_t y = 0; y <= 4 * 16; ++y) {
      for (std::int32_t t = 0; t <= 4 * width; ++t) {
        points.push_back({step * rise + t * kStep, y * kStep, step * rise});
        points.push_back({step * rise, y * kStep, (step - 1) * rise + t * kStep});
      }
    }
  }
  return test::voxel_tile_of(kSide, points);
}

TEST(VoxelNormals, StepsOfThreeVoxelsBetweenFolds_AreTreadsAndRisersNotASlope) {
  constexpr std::int32_t kWidth = 4;
  const VoxelTile tile = staircase(kWidth);
  const auto normals = voxel_normals(tile);
  int faces = 0;
  int right = 0;
  for (std::size_t v = 0; v < tile.size(); ++v) {
    const LatticePoint& k = tile.keys[v];
    const bool tread = k.x % kWidth != 0;
    const bool riser = k.z % kWidth != 0;
    if (k.x < kWidth || k.x > 6 * kWidth || tread == riser) continue;  // On a fold, or at the ends of the stairs.
    ++faces;
    right += angle_deg(tread ? Vector{0, 0, 1} : Vector{1, 0, 0}, normals[v]) < 3.0;
  }
  EXPECT_GT(faces, 300);
  EXPECT_EQ(right, faces);
}

TEST(VoxelNormals, LoneVoxelsPairsAndLines_HaveNone) {
  std::vector<LatticePoint> points{{0, 0, 0}, {100 * kSide, 0, 0}, {101 * kSide, kSide, 0}};
  for (std::int32_t i = 0; i < 12; ++i) {
    points.push_back({i * kSide, 50 * kSide, 0});
    points.push_back({i * kSide, (100 + i) * kSide, i * kSide});
    points.push_back({-i * kSide, (-100 + i) * kSide, 0});
  }
  const VoxelTile tile = test::voxel_tile_of(kSide, points);
  ASSERT_EQ(tile.size(), points.size());
  for (const auto& normal : voxel_normals(tile)) EXPECT_EQ(normal, (std::array<float, 3>{}));
  EXPECT_TRUE(voxel_normals(test::voxel_tile_of(kSide, {})).empty());
}

RC_GTEST_PROP(VoxelNormals, MovedByWholeVoxels_AreTheSameBits, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>().as("seed");
  const VoxelTile tile = test::voxel_tile_of(20, test::bumpy_surface(1500, 600, seed).points);
  const auto by = [] { return *rc::gen::inRange(-(1 << 26), 1 << 26); };
  const LatticePoint shift{by(), by(), by()};
  RC_ASSERT(voxel_normals(test::moved(tile, shift)) == voxel_normals(tile));
}

RC_GTEST_PROP(VoxelNormals, CutFourRingsAway_AreTheSameBits, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("seed"));
  const VoxelTile tile = test::voxel_tile_of(20, test::bumpy_surface(2500, 600, random()).points);
  const auto whole = voxel_normals(tile);
  std::vector<std::uint32_t> from;
  const VoxelTile part = test::part_of(tile, test::any_core(tile, random), 4, from);
  const auto normals = voxel_normals(part);
  for (std::size_t v = 0; v < part.size(); ++v) {
    if (part.core[v] != 0) RC_ASSERT(normals[v] == whole[from[v]]);
  }
}

}  // namespace
}  // namespace arris
