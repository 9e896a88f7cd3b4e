#include "features/supervoxel/cie_lab.h"

#include <cmath>

namespace arris {
namespace {

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

double lightness_root(double t) {
  constexpr double kEdge = 6.0 / 29.0;
  return t > kEdge * kEdge * kEdge ? std::cbrt(t) : t / (3.0 * kEdge * kEdge) + 4.0 / 29.0;
}

}  // namespace

std::array<float, 3> cie_lab(const std::array<double, 3>& srgb) {
  const double r = linear(srgb[0]);
  const double g = linear(srgb[1]);
  const double b = linear(srgb[2]);
  const double x = lightness_root((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
  const double y = lightness_root(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
  const double z = lightness_root((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {static_cast<float>(116.0 * y - 16.0), static_cast<float>(500.0 * (x - y)),
          static_cast<float>(200.0 * (y - z))};
}

}  // namespace arris
