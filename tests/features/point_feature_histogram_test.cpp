#include "features/supervoxel/point_feature_histogram.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "features/supervoxel/voxel_normals.h"
#include "voxel_tile_testing.h"

namespace arris {
namespace {

using Vector = std::array<double, 3>;
constexpr double kPi = 3.14159265358979323846;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector scaled(const Vector& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}
Vector unit(const Vector& a) {
  return scaled(a, 1.0 / std::sqrt(dot(a, a)));
}

struct LiteralFeatures {
  double alpha, phi, theta;
  double tie;       ///< How far the angles of the two normals with the line are apart.
  double parallel;  ///< How far the line is from either normal.
};

/// Rusu, Blodow, Beetz 2009, section III: source is the point whose normal makes the smaller angle with the line.
std::optional<LiteralFeatures> literal_features(Vector line, Vector n1, Vector n2) {
  if (dot(line, line) == 0.0) return std::nullopt;
  line = unit(line);
  const double angle1 = std::acos(std::min(1.0, std::abs(dot(n1, line))));
  const double angle2 = std::acos(std::min(1.0, std::abs(dot(n2, line))));
  if (angle1 > angle2) {
    std::swap(n1, n2);
    line = scaled(line, -1.0);
  }
  const Vector u = n1;
  const Vector v = unit(cross(line, u));
  const Vector w = cross(u, v);
  return LiteralFeatures{dot(v, n2), dot(u, line), std::atan2(dot(w, n2), dot(u, n2)), std::abs(angle1 - angle2),
                         std::min(angle1, angle2)};
}

Vector any_vector(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}
std::array<float, 3> floats(const Vector& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}
double angle_between(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * kPi));
}

TEST(PairFeatures, RandomPairs_AreThoseOfThePaper) {
  std::mt19937_64 random(1);
  int compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vector line = scaled(any_vector(random), 1000.0);
    const Vector n1 = unit(any_vector(random));
    const Vector n2 = unit(any_vector(random));
    const auto expected = literal_features(line, n1, n2);
    if (expected->tie < 1e-3 || expected->parallel < 1e-3) continue;
    ++compared;
    PairFeatures f{};
    ASSERT_TRUE(pair_features(floats(line), floats(n1), floats(n2), f));
    ASSERT_NEAR(f.alpha, expected->alpha, 1e-4);
    ASSERT_NEAR(f.phi, expected->phi, 1e-4);
    // Both components of atan2 are small where alpha is near 1.
    ASSERT_LT(angle_between(f.theta, expected->theta) * std::sqrt(1.0 - expected->alpha * expected->alpha), 1e-4);
    PairFeatures swapped{};
    ASSERT_TRUE(pair_features(floats(scaled(line, -1.0)), floats(n2), floats(n1), swapped));
    ASSERT_NEAR(swapped.alpha, f.alpha, 1e-5);
    ASSERT_NEAR(swapped.phi, f.phi, 1e-5);
  }
  EXPECT_GT(compared, 19'000);
}

TEST(PairFeatures, CoincidentPointsAndLinesAlongTheNormal_HaveNone) {
  PairFeatures f{};
  EXPECT_FALSE(pair_features({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, f));
  EXPECT_FALSE(pair_features({0, 0, 5}, {0, 0, 1}, {0, 0, 1}, f));
  EXPECT_FALSE(pair_features({0, 0, 5}, {1, 0, 0}, {0, 0, -1}, f)) << "the second becomes the source";
  EXPECT_TRUE(pair_features({3, 0, 0}, {0, 0, 1}, {0, 0, 1}, f));
  EXPECT_EQ(f.alpha, 0.0F);
  EXPECT_EQ(f.phi, 0.0F);
  EXPECT_EQ(f.theta, 0.0F);
}

using Bins = std::array<double, kHistogramBins>;

Bins literal_simplified(const VoxelTile& tile, const PageVector<std::array<float, 3>>& normals, std::uint32_t v) {
  Bins bins{};
  const auto vector = [](const std::array<float, 3>& n) { return Vector{n[0], n[1], n[2]}; };
  double pairs = 0.0;
  for (const std::uint32_t u : tile.neighbours_of(v)) {
    if (normals[v] == std::array<float, 3>{} || normals[u] == std::array<float, 3>{}) continue;
    Vector line;
    for (std::size_t i = 0; i < 3; ++i) line[i] = difference(tile.positions[u][i], tile.positions[v][i]);
    const auto f = literal_features(line, vector(normals[v]), vector(normals[u]));
    if (!f || f->parallel < 1e-7) continue;
    const auto count = [&](std::size_t part, double share) {
      bins[11 * part + static_cast<std::size_t>(std::clamp(std::floor(11.0 * share), 0.0, 10.0))] += 1.0;
    };
    count(0, (f->alpha + 1.0) / 2.0);
    count(1, (f->phi + 1.0) / 2.0);
    count(2, (f->theta + kPi) / (2.0 * kPi));
    pairs += 1.0;
  }
  for (double& bin : bins) bin /= std::max(1.0, pairs);
  return bins;
}

/// FPFH = SPFH + 1 / k sum SPFH / distance, each part scaled to a third of the total.
Bins literal_histogram(const VoxelTile& tile, const std::vector<Bins>& simplified, std::uint32_t v) {
  Bins bins = simplified[v];
  const auto neighbours = tile.neighbours_of(v);
  for (const std::uint32_t u : neighbours) {
    double squared = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = difference(tile.positions[u][i], tile.positions[v][i]);
      squared += d * d;
    }
    const double distance = std::sqrt(squared) / (kVoxelFractions * tile.grid.side_steps());
    if (distance == 0.0) continue;
    for (std::size_t i = 0; i < bins.size(); ++i)
      bins[i] += simplified[u][i] / (distance * static_cast<double>(neighbours.size()));
  }
  for (std::size_t part = 0; part < 3; ++part) {
    double total = 0.0;
    for (std::size_t i = 0; i < 11; ++i) total += bins[11 * part + i];
    for (std::size_t i = 0; i < 11; ++i) bins[11 * part + i] *= total > 0.0 ? kHistogramTotal / 3 / total : 0.0;
  }
  return bins;
}

TEST(FeatureHistograms, BumpySurface_AreThoseOfThePaper) {
  const VoxelTile tile = test::voxel_tile_of(20, test::bumpy_surface(4000, 600, 3).points);
  const auto normals = voxel_normals(tile);
  const auto histograms = feature_histograms(tile, normals);
  std::vector<Bins> simplified;
  for (std::uint32_t v = 0; v < tile.size(); ++v) simplified.push_back(literal_simplified(tile, normals, v));
  std::size_t equal = 0;
  for (std::uint32_t v = 0; v < tile.size(); ++v) {
    const Bins expected = literal_histogram(tile, simplified, v);
    double off = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) off = std::max(off, std::abs(histograms[v][i] - expected[i]));
    equal += off <= 1.0;
  }
  // Where a feature lies on the border of two bins, or two normals are equally near to the line, rounding decides.
  EXPECT_GT(static_cast<double>(equal), 0.97 * static_cast<double>(tile.size()));
}

TEST(FeatureHistograms, BumpySurface_TotalsAndDistancesKeepTheirBounds) {
  const VoxelTile tile = test::voxel_tile_of(20, test::bumpy_surface(4000, 600, 5).points);
  const auto histograms = feature_histograms(tile, voxel_normals(tile));
  for (std::size_t v = 0; v < tile.size(); ++v) {
    const FeatureHistogram& h = histograms[v];
    for (std::size_t part = 0; part < 3; ++part) {
      const int total =
          std::accumulate(h.begin() + static_cast<long>(11 * part), h.begin() + static_cast<long>(11 * part + 11), 0);
      EXPECT_NEAR(total, kHistogramTotal / 3, 6) << "each of 11 bins is rounded";
    }
    for (std::size_t i = 0; i < h.size(); ++i) EXPECT_GE(h[i], 0);
    for (std::size_t i = kHistogramBins; i < h.size(); ++i) EXPECT_EQ(h[i], 0);
    EXPECT_LT(intersection_distance(h, h), 1e-3F);
    const FeatureHistogram& other = histograms[(7 * v + 3) % tile.size()];
    const float distance = intersection_distance(h, other);
    EXPECT_GE(distance, 0.0F);
    EXPECT_LE(distance, 1.0F);
    EXPECT_EQ(distance, intersection_distance(other, h));
  }
}

TEST(FeatureHistograms, Plane_IsOneBinPerPart) {
  std::vector<LatticePoint> points;
  for (std::int32_t i = 0; i < 60; ++i) {
    for (std::int32_t j = 0; j < 60; ++j) points.push_back({10 * i, 10 * j, 0});
  }
  const VoxelTile tile = test::voxel_tile_of(40, points);
  for (const FeatureHistogram& h : feature_histograms(tile, voxel_normals(tile))) {
    for (std::size_t part = 0; part < 3; ++part) EXPECT_EQ(h[11 * part + 5], kHistogramTotal / 3);
  }
}

TEST(FeatureHistograms, FoldAndPlane_AreFarApart) {
  std::vector<LatticePoint> points;
  for (std::int32_t i = 0; i < 80; ++i) {
    for (std::int32_t j = 0; j < 60; ++j) {
      points.push_back({10 * i, 10 * j, 0});
      points.push_back({0, 10 * j, 10 * i});
    }
  }
  const VoxelTile tile = test::voxel_tile_of(40, points);
  const auto histograms = feature_histograms(tile, voxel_normals(tile));
  const auto at = [&](const LatticePoint& key) {
    return histograms[static_cast<std::size_t>(std::find(tile.keys.begin(), tile.keys.end(), key) - tile.keys.begin())];
  };
  EXPECT_GT(intersection_distance(at({0, 7, 0}), at({10, 7, 0})), 0.15F);
  EXPECT_LT(intersection_distance(at({0, 7, 9}), at({10, 7, 0})), 0.01F) << "flat parts are alike, however they lie";
}

TEST(FeatureHistograms, LoneVoxels_AreAllZeroAndFarFromEverything) {
  const VoxelTile tile = test::voxel_tile_of(10, {{0, 0, 0}, {1000, 0, 0}});
  const auto histograms = feature_histograms(tile, voxel_normals(tile));
  ASSERT_EQ(histograms.size(), 2U);
  EXPECT_EQ(histograms[0], FeatureHistogram{});
  EXPECT_EQ(intersection_distance(histograms[0], histograms[1]), 1.0F);
}

}  // namespace
}  // namespace arris
