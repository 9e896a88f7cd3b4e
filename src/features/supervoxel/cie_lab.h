#pragma once
/// @file CIELab colours.

#include <array>

namespace arris {

/// L in [0, 100], a and b about [-128, 128], of sRGB channels in [0, 1] under illuminant D65 (IEC 61966-2-1, CIE 15).
std::array<float, 3> cie_lab(const std::array<double, 3>& srgb);

}  // namespace arris
