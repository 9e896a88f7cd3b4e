#include "features/supervoxel/cie_lab.h"

#include <gtest/gtest.h>

namespace arris {
namespace {

struct KnownColour {
  std::array<double, 3> srgb;
  std::array<float, 3> lab;
};

// Values of CIE 15 for the white of IEC 61966-2-1, as tables of sRGB colours print them.
TEST(CieLab, KnownColours_AreWithinAFewHundredths) {
  const double grey = 119.0 / 255.0;
  for (const KnownColour& known : {KnownColour{{1, 1, 1}, {100.0F, 0.0F, 0.0F}},
                                   {{0, 0, 0}, {0.0F, 0.0F, 0.0F}},
                                   {{1, 0, 0}, {53.24F, 80.09F, 67.20F}},
                                   {{0, 1, 0}, {87.73F, -86.18F, 83.18F}},
                                   {{0, 0, 1}, {32.30F, 79.19F, -107.86F}},
                                   {{1, 1, 0}, {97.14F, -21.55F, 94.48F}},
                                   {{grey, grey, grey}, {50.03F, 0.0F, 0.0F}}}) {
    const std::array<float, 3> lab = cie_lab(known.srgb);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(lab[i], known.lab[i], 0.05) << known.srgb[0] << known.srgb[1] << known.srgb[2] << " " << i;
  }
}

TEST(CieLab, DarkColours_GoOnWithoutAJump) {
  // Both curves (of sRGB at 0.04045, of CIELab at L = 8) have a straight part near black.
  float last = -1.0F;
  for (int i = 0; i <= 2000; ++i) {
    const double v = i / 10000.0;
    const float lightness = cie_lab({v, v, v})[0];
    EXPECT_GT(lightness, last);
    if (i > 0) {
      EXPECT_LT(lightness - last, 0.03F) << v;
    }
    last = lightness;
  }
}

}  // namespace
}  // namespace arris
