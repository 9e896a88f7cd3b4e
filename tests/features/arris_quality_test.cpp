// Which folds the defaults of arris find, and what they do not invent.

#include <gtest/gtest.h>

#include <cmath>

#include "ball_testing.h"
#include "contour_scenes.h"
#include "core/columns.h"
#include "features/arris/arris_method.h"
#include "features/numerics/exact_math.h"

namespace arris {
namespace {

using test::Point;
using test::Random;
using test::Scene;

constexpr double kStep = 0.001;
constexpr double kSpacing = 0.25;

ContourRecords contours_of(const Scene& scene) {
  ArrisParameters parameters;
  parameters.max_radius = 40.0 * kSpacing;
  return extract_arris(test::tile_of(scene, kStep), {kStep, {0.0, 0.0, 0.0}}, parameters).records;
}

/// One jittered point per cell of a width x height grid, placed by at(u, v), all in spacings.
template <class At>
void add_surface(Scene& scene, int width, int height, double noise, Random& random, At&& at) {
  for (int i = 0; i < width; ++i) {
    for (int j = 0; j < height; ++j) {
      const double u = i + random.in(0.25, 0.75);
      const double v = j + random.in(0.25, 0.75);
      Point p = at(u, v);
      for (double& c : p) c = (c + noise * random.normal()) * kSpacing;
      scene.points.push_back(p);
    }
  }
}

/// Share of the points selected by `inside` (of coordinates in spacings) that are called contours.
template <class Inside>
double false_alarms(const Scene& scene, Inside&& inside) {
  const auto count = [&](const Point& p) { return inside(p[0] / kSpacing, p[1] / kSpacing, p[2] / kSpacing); };
  double all = 0.0, alarms = 0.0;
  for (const Point& p : scene.points) all += count(p);
  for (const ContourRecord& r : contours_of(scene)) alarms += count(scene.points[r.id]);
  return alarms / all;
}

constexpr double kMostFalseAlarms = 0.001;

class Noise : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Spacings, Noise, testing::Values(0.0, 0.2, 0.4));

TEST_P(Noise, PlaneInterior_HasNoContours) {
  Random random(1);
  Scene scene;
  scene.spacing = kSpacing;
  add_surface(scene, 120, 120, GetParam(), random, [](double u, double v) { return Point{u, v, 0.3 * u - 0.2 * v}; });
  const double share =
      false_alarms(scene, [](double x, double y, double) { return x > 6.0 && x < 114.0 && y > 6.0 && y < 114.0; });
  RecordProperty("share", std::to_string(share));
  EXPECT_LT(share, kMostFalseAlarms);
}

TEST_P(Noise, SphereOfFiftySpacings_HasNoContours) {
  constexpr double kRadius = 50.0;
  const double noise = GetParam();
  Random random(2);
  Scene scene;
  scene.spacing = kSpacing;
  // Rings of one spacing each.
  for (int ring = 0; ring < 157; ++ring) {
    const double polar = (ring + 0.5) / kRadius;
    const int count = std::max(1, static_cast<int>(2.0 * kPi * kRadius * std::sin(polar)));
    for (int i = 0; i < count; ++i) {
      const double a = polar + random.in(-0.25, 0.25) / kRadius;
      const double b = 2.0 * kPi * (i + random.in(-0.25, 0.25)) / count;
      Point p{kRadius * std::sin(a) * std::cos(b), kRadius * std::sin(a) * std::sin(b), kRadius * std::cos(a)};
      for (double& c : p) c = (c + noise * random.normal()) * kSpacing;
      scene.points.push_back(p);
    }
  }
  const double share = false_alarms(scene, [](double, double, double) { return true; });
  RecordProperty("share", std::to_string(share));
  EXPECT_LT(share, kMostFalseAlarms);
}

TEST(NoiseCube, Interior_HasNoContours) {
  Random random(3);
  Scene scene;
  scene.spacing = kSpacing;
  for (int i = 0; i < 30000; ++i) {
    scene.points.push_back(
        {random.in(0.0, 32.0) * kSpacing, random.in(0.0, 32.0) * kSpacing, random.in(0.0, 32.0) * kSpacing});
  }
  const auto inner = [](double c) { return c > 6.0 && c < 26.0; };
  const double share =
      false_alarms(scene, [&](double x, double y, double z) { return inner(x) && inner(y) && inner(z); });
  RecordProperty("share", std::to_string(share));
  EXPECT_LT(share, kMostFalseAlarms);
}

struct Dihedral {
  double angle_deg;
  double noise;
};

void PrintTo(const Dihedral& d, std::ostream* out) {
  *out << d.angle_deg << " degrees, noise " << d.noise << " spacings";
}

class DihedralFold : public testing::TestWithParam<Dihedral> {};

TEST_P(DihedralFold, NineTenthsOfTheLineAreFound) {
  constexpr int kLength = 160;
  constexpr int kWidth = 24;
  const double half = 0.5 * GetParam().angle_deg / kDegreesPerRadian;
  Random random(4);
  Scene scene;
  scene.spacing = kSpacing;
  for (const double side : {-1.0, 1.0}) {
    add_surface(scene, kLength, kWidth, GetParam().noise, random, [&](double u, double v) {
      return Point{u, side * v * std::sin(half), v * std::cos(half)};
    });
  }
  for (double x = 8.0; x <= kLength - 8.0; x += 0.5) scene.truth.push_back({x * kSpacing, 0.0, 0.0});
  const test::Score found = score(scene, contours_of(scene), kFold, kSpacing);
  RecordProperty("recall", std::to_string(found.recall));
  EXPECT_GE(found.recall, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Quiet, DihedralFold,
                         testing::Values(Dihedral{40, 0}, Dihedral{60, 0}, Dihedral{80, 0}, Dihedral{100, 0},
                                         Dihedral{120, 0}, Dihedral{140, 0}));
INSTANTIATE_TEST_SUITE_P(Noisy, DihedralFold,
                         testing::Values(Dihedral{40, 0.2}, Dihedral{60, 0.2}, Dihedral{80, 0.2}, Dihedral{100, 0.2},
                                         Dihedral{120, 0.2}));

}  // namespace
}  // namespace arris
