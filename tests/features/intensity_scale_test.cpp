#include "features/segment/intensity_scale.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace arris {
namespace {

using Values = IntensityPercentiles::Values;

/// In chunks, as passes over files see them.
IntensityScale scale_of(const std::vector<double>& intensities, Values values, std::size_t chunk = 7) {
  IntensityPercentiles percentiles(values);
  const auto feed = [&](auto&& take) {
    for (std::size_t i = 0; i < intensities.size(); i += chunk)
      take(std::span(intensities).subspan(i, std::min(chunk, intensities.size() - i)));
  };
  feed([&](auto part) { percentiles.add(part); });
  if (percentiles.needs_refining()) feed([&](auto part) { percentiles.refine(part); });
  return percentiles.scale();
}

std::vector<double> counting(double first, double step, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(first + step * i);
  return values;
}

TEST(IntensityScale, EightBits_StayAsTheyAre) {
  for (const Values kind : {Values::kWords, Values::kAny}) {
    const IntensityScale scale = scale_of({0, 255, 17, 3}, kind);
    EXPECT_FALSE(scale.scaled);
    EXPECT_EQ(scale.byte_of(17), 17);
    EXPECT_EQ(scale.byte_of(255), 255);
  }
  const IntensityScale fractions = scale_of({0.25, 254.5, 7.49}, Values::kAny);
  EXPECT_FALSE(fractions.scaled);
  EXPECT_EQ(fractions.byte_of(254.5), 255);
  EXPECT_EQ(fractions.byte_of(7.49), 7);
  EXPECT_FALSE(scale_of({0, 1, 1}, Values::kAny).scaled) << "whole numbers";
  EXPECT_FALSE(scale_of({}, Values::kAny).scaled);
}

TEST(IntensityScale, Words_RunFromThe1stToThe99thPercentile) {
  for (const Values kind : {Values::kWords, Values::kAny}) {
    const IntensityScale scale = scale_of(counting(0, 10, 1001), kind);
    EXPECT_TRUE(scale.scaled);
    EXPECT_EQ(scale.low, 100.0);
    EXPECT_EQ(scale.high, 9900.0);
    EXPECT_EQ(scale.byte_of(0), 0);
    EXPECT_EQ(scale.byte_of(100), 0);
    EXPECT_EQ(scale.byte_of(5000), 128);
    EXPECT_EQ(scale.byte_of(9900), 255);
    EXPECT_EQ(scale.byte_of(65535), 255);
  }
}

TEST(IntensityScale, FractionsOfOneAndDecibels_AreScaled) {
  const IntensityScale unit = scale_of(counting(0, 0.001, 1001), Values::kAny);
  EXPECT_TRUE(unit.scaled);
  EXPECT_NEAR(unit.low, 0.01, 1e-6);
  EXPECT_NEAR(unit.high, 0.99, 1e-6);
  const IntensityScale decibels = scale_of(counting(-25, 0.025, 1001), Values::kAny);
  EXPECT_NEAR(decibels.low, -24.75, 1e-6);
  EXPECT_NEAR(decibels.high, -0.25, 1e-6);
  EXPECT_EQ(decibels.byte_of(-12.5), 128);
}

TEST(IntensityScale, OneValueOnly_Becomes0) {
  EXPECT_EQ(scale_of({4000, 4000, 4000}, Values::kWords).byte_of(4000), 0);
  EXPECT_EQ(scale_of({1000.1, 1000.1}, Values::kAny).byte_of(1000.1), 0) << "no float32";
  // Almost one value only: the rest is told apart from it.
  std::vector<double> values(1000, 300.0);
  values[17] = 9000;
  values[18] = 2;
  const IntensityScale scale = scale_of(values, Values::kWords);
  EXPECT_EQ(scale.byte_of(300), 0);
  EXPECT_EQ(scale.byte_of(2), 0);
  EXPECT_EQ(scale.byte_of(9000), 255);
}

TEST(IntensityScale, ValuesThatAreNoNumbers_DoNotCount) {
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<double> values = counting(0, 10, 1001);
  for (const double odd : {nan, inf, -inf}) values.insert(values.begin() + 5, 50, odd);
  const IntensityScale scale = scale_of(values, Values::kAny);
  EXPECT_EQ(scale.low, 100.0);
  EXPECT_EQ(scale.high, 9900.0);
  EXPECT_EQ(scale.byte_of(nan), 0);
  EXPECT_EQ(scale.byte_of(-inf), 0);
  EXPECT_EQ(scale.byte_of(inf), 255);
  EXPECT_EQ(IntensityScale{}.byte_of(nan), 0);
  EXPECT_EQ(IntensityScale{}.byte_of(-inf), 0);
  EXPECT_EQ(IntensityScale{}.byte_of(inf), 255);
  EXPECT_EQ(scale_of({1e300, -1e300, 0}, Values::kAny).byte_of(0), 128);
}

RC_GTEST_PROP(IntensityScaleLaws, Percentiles_AreThoseOfTheSortedValues, ()) {
  const bool words = *rc::gen::arbitrary<bool>();
  std::vector<double> values;
  if (words) {
    for (const std::uint16_t v : *rc::gen::nonEmpty<std::vector<std::uint16_t>>()) values.push_back(v);
  } else {
    for (const float v : *rc::gen::nonEmpty<std::vector<float>>()) values.push_back(std::isfinite(v) ? v : 0.0F);
  }
  const std::size_t repeat = *rc::gen::inRange<std::size_t>(1, 30);
  const std::size_t distinct = values.size();
  for (std::size_t r = 1; r < repeat; ++r) {
    for (std::size_t i = 0; i < distinct; ++i) values.push_back(values[i]);
  }
  values.push_back(1000.0);  // No 8 bits.
  const Values kind = words ? Values::kWords : Values::kAny;
  const IntensityScale scale = scale_of(values, kind, *rc::gen::inRange<std::size_t>(1, 50));
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  const std::size_t skipped = (sorted.size() - 1) / 100;
  RC_ASSERT(scale.scaled);
  RC_ASSERT(scale.low == sorted[skipped]);
  RC_ASSERT(scale.high == sorted[sorted.size() - 1 - skipped]);
  std::uint8_t before = 0;
  for (const double value : sorted) {
    RC_ASSERT(scale.byte_of(value) >= before);
    before = scale.byte_of(value);
  }
  // The order of the values plays no part.
  std::ranges::reverse(values);
  const IntensityScale reversed = scale_of(values, kind);
  RC_ASSERT(reversed.low == scale.low && reversed.high == scale.high);
}

}  // namespace
}  // namespace arris
