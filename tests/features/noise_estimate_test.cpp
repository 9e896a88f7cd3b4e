// Noise and spacing from a sample.

#include "features/segment/noise_estimate.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace arris {
namespace {

/// A tilted plane of random points, `spacing` steps apart, in a cube of `side` steps.
std::vector<LatticePoint> noisy_plane(double noise, double spacing, std::int32_t side, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, side);
  std::normal_distribution<double> gauss(0.0, noise * spacing);
  std::vector<LatticePoint> points(static_cast<std::size_t>(side * (side * 1.044) / (spacing * spacing)));
  for (LatticePoint& p : points) {
    const double x = uniform(random), y = uniform(random);
    p = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
         static_cast<std::int32_t>(std::lround(0.5 * side + 0.3 * (x - 0.5 * side) + gauss(random)))};
  }
  return points;
}

LatticeBox cube(std::int32_t side) {
  return {{0, 0, 0}, {side, side, side}};
}

TEST(NoiseEstimate, NoisyPlanes_AreToldToAQuarter) {
  std::mt19937_64 random(4);
  for (const double noise : {0.05, 0.1, 0.2, 0.3}) {
    NoiseEstimate estimate;
    for (int cell = 0; cell < 20; ++cell) estimate.add(noisy_plane(noise, 200.0, 4800, random), cube(4800));
    EXPECT_NEAR(estimate.noise() / 200.0, noise, 0.25 * noise);
    EXPECT_NEAR(estimate.least_spacing() / 200.0, 0.65, 0.15);
  }
}

TEST(NoiseEstimate, NoNoise_IsNearlyZero) {
  std::mt19937_64 random(5);
  NoiseEstimate estimate;
  estimate.add(noisy_plane(0.0, 200.0, 9600, random), cube(9600));
  EXPECT_LT(estimate.noise() / 200.0, 0.005);
}

TEST(NoiseEstimate, FewCoincidentOrCollinearPoints_SayNothing) {
  NoiseEstimate estimate;
  estimate.add({}, cube(100));
  estimate.add(std::vector<LatticePoint>(5, LatticePoint{1, 2, 3}), cube(100));
  estimate.add(std::vector<LatticePoint>(500, LatticePoint{50, 50, 50}), cube(100));
  std::vector<LatticePoint> line;
  for (std::int32_t i = 0; i < 400; ++i) line.push_back({i, 200, 200});
  estimate.add(line, cube(400));
  EXPECT_EQ(estimate.noise(), 0.0);
  EXPECT_EQ(estimate.least_spacing(), 0.0);
}

RC_GTEST_PROP(NoiseEstimate, OrderAndDuplicatesDoNotMatter, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::vector<LatticePoint> points = noisy_plane(0.2, 200.0, 4800, random);
  NoiseEstimate one, other;
  one.add(points, cube(4800));
  points.insert(points.end(), points.begin(), points.begin() + 50);
  std::shuffle(points.begin(), points.end(), random);
  other.add(points, cube(4800));
  RC_ASSERT(one.noise() == other.noise());
  RC_ASSERT(one.least_spacing() == other.least_spacing());
}

// A sparse half without noise, as planes far from a scanner are, and a dense one.
TEST(NoiseEstimate, DensestQuarter_TellsTheNoise) {
  std::mt19937_64 random(6);
  NoiseEstimate estimate;
  for (int cell = 0; cell < 20; ++cell) {
    estimate.add(noisy_plane(0.0, 400.0, 9600, random), cube(9600));
    estimate.add(noisy_plane(0.3, 100.0, 4800, random), cube(4800));
  }
  EXPECT_NEAR(estimate.noise(), 30.0, 8.0);
}

}  // namespace
}  // namespace arris
