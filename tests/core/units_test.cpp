#include "core/units.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace arris {
namespace {

TEST(ParseSize, Units_AreBinaryUnlessWrittenDecimal) {
  EXPECT_EQ(parse_size_bytes("8G", 0), 8ULL << 30);
  EXPECT_EQ(parse_size_bytes("8GiB", 0), 8ULL << 30);
  EXPECT_EQ(parse_size_bytes("512MiB", 0), 512ULL << 20);
  EXPECT_EQ(parse_size_bytes("2GB", 0), 2'000'000'000ULL);
  EXPECT_EQ(parse_size_bytes("1.5 KiB", 0), 1536ULL);
  EXPECT_EQ(parse_size_bytes("12345", 0), 12345ULL);
  EXPECT_EQ(parse_size_bytes("60%", 1000), 600ULL);
}

TEST(ParseSize, Nonsense_IsAConfigError) {
  for (const char* text : {"", "x", "-1G", "0", "8 G B", "8Q", "nan", "inf", "1e300", "120%", "5G5"}) {
    EXPECT_THROW(parse_size_bytes(text, 1000), ConfigError) << text;
  }
}

TEST(ParseLength, Units_AreConvertedToMetres) {
  EXPECT_DOUBLE_EQ(parse_length("0.03"), 0.03);
  EXPECT_DOUBLE_EQ(parse_length("5 cm"), 0.05);
  EXPECT_DOUBLE_EQ(parse_length("30mm"), 0.03);
  EXPECT_DOUBLE_EQ(parse_length("2ft"), 0.6096);
}

TEST(ParseLength, NegativeOrUnknownUnit_IsAConfigError) {
  for (const char* text : {"", "-1", "5 parsec", "nan", "inf", "cm"})
    EXPECT_THROW(parse_length(text), ConfigError) << text;
}

TEST(ParseAngle, PlainNumbers_AreDegrees) {
  EXPECT_DOUBLE_EQ(parse_angle_deg("120"), 120.0);
  EXPECT_DOUBLE_EQ(parse_angle_deg("90 deg"), 90.0);
  EXPECT_THROW(parse_angle_deg("1 rad"), ConfigError);
}

}  // namespace
}  // namespace arris
