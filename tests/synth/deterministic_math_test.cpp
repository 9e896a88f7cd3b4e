#include "synth/deterministic_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene_testing.h"
#include "synth/counter_random.h"

namespace arris::synth {
namespace {

TEST(DeterministicMath_SinCos, ManyTurns_AgreeWithTheStandardLibrary) {
  for (int i = -5000; i <= 5000; ++i) {
    const double turns = i * 0.00037;
    const SinCos value = sin_cos_turns(turns);
    const long double angle = 2.0L * std::numbers::pi_v<long double> * static_cast<long double>(turns);
    EXPECT_NEAR(value.sin, static_cast<double>(std::sin(angle)), 5e-16);
    EXPECT_NEAR(value.cos, static_cast<double>(std::cos(angle)), 5e-16);
  }
}

TEST(DeterministicMath_SinCos, Quarters_AreExact) {
  for (int i = -8; i <= 8; ++i) {
    const SinCos value = sin_cos_turns(0.25 * i);
    EXPECT_EQ(std::abs(value.sin), i % 2 == 0 ? 0.0 : 1.0);
    EXPECT_EQ(std::abs(value.cos), i % 2 == 0 ? 1.0 : 0.0);
  }
}

TEST(DeterministicMath_Log, AllMagnitudes_AgreeWithTheStandardLibrary) {
  for (int i = -600; i <= 600; ++i) {
    const double x = std::pow(3.0, i) * 1.234;
    EXPECT_NEAR(natural_log(x), std::log(x), 1e-15 * (1.0 + std::abs(std::log(x))));
  }
  EXPECT_EQ(natural_log(1.0), 0.0);
}

TEST(DeterministicMath_CubeRoot, AllMagnitudes_CubeBack) {
  for (int i = -200; i <= 200; ++i) {
    const double x = std::pow(7.0, i);
    EXPECT_NEAR(cube_root(x) / std::cbrt(x), 1.0, 1e-15);
  }
  EXPECT_EQ(cube_root(0.0), 0.0);
}

TEST(DeterministicMath_NormalQuantile, DistributionFunctionOfIt_IsTheProbability) {
  for (const double p :
       {1e-15, 1e-10, 1e-5, 0.001, 0.02, 0.074, 0.076, 0.3, 0.5, 0.7, 0.924, 0.926, 0.999, 1 - 1e-10}) {
    const double x = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-x / std::numbers::sqrt2) / p, 1.0, 1e-12) << p;
  }
}

TEST(PointRandom_Uniform, ManyCounters_AreUniformAndUncorrelated) {
  std::vector<double> values, products;
  double previous = 0.5;
  for (std::uint64_t i = 0; i < 200'000; ++i) {
    const double value = PointRandom(derive_key(7, i)).uniform();
    ASSERT_GT(value, 0.0);
    ASSERT_LT(value, 1.0);
    values.push_back(value);
    products.push_back((value - 0.5) * (previous - 0.5));
    previous = value;
  }
  // Five standard errors.
  EXPECT_NEAR(mean(values), 0.5, 5 * std::sqrt(1.0 / 12 / 200'000));
  EXPECT_NEAR(standard_deviation(values), std::sqrt(1.0 / 12), 0.002);
  EXPECT_NEAR(mean(products), 0.0, 5.0 / 12 / std::sqrt(200'000.0));
}

TEST(PointRandom_Normal, Moments_AreThoseOfTheNormalDistribution) {
  std::vector<double> values, fourth;
  PointRandom random(3);
  for (int i = 0; i < 200'000; ++i) {
    values.push_back(random.normal());
    fourth.push_back(std::pow(values.back(), 4));
  }
  EXPECT_NEAR(mean(values), 0.0, 0.012);
  EXPECT_NEAR(standard_deviation(values), 1.0, 0.01);
  EXPECT_NEAR(mean(fourth), 3.0, 0.12);
}

}  // namespace
}  // namespace arris::synth
