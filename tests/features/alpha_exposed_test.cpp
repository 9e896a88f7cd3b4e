// Exposure against discs tried one by one and against a Delaunay triangulation made of all triples.

#include "features/planar/alpha_exposed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ball_testing.h"
#include "features/numerics/exact_math.h"

namespace arris {
namespace {

using Planar = std::array<double, 2>;
using Cloud = std::vector<Planar>;

PlaneNeighbours around(const Cloud& cloud, std::size_t p, double alpha) {
  PlaneNeighbours neighbours;
  for (const Planar& q : cloud) {
    neighbours.a.push_back((q[0] - cloud[p][0]) / (2.0 * alpha));
    neighbours.b.push_back((q[1] - cloud[p][1]) / (2.0 * alpha));
  }
  neighbours.count = cloud.size();
  return neighbours;
}

double exposure_deg(const Cloud& cloud, std::size_t p, double alpha) {
  AlphaExposure exposed;
  const PlaneNeighbours neighbours = around(cloud, p, alpha);
  const double free_deg = exposed(neighbours);
  EXPECT_EQ(free_deg, exposed.without_rejection(neighbours));
  return free_deg;
}

double distance(const Planar& a, const Planar& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

/// An empty disc that touches p can be turned about p until it touches another point (or there is none in reach): so it
/// suffices to try, for each neighbour, the two discs through p and it, turned away from it by a trifle.
bool exposed_by_discs(const Cloud& cloud, std::size_t p, double alpha) {
  bool alone = true;
  for (const Planar& q : cloud) {
    const double d = distance(q, cloud[p]);
    if (d == 0.0 || d >= 2.0 * alpha) continue;
    alone = false;
    const double towards = std::atan2(q[1] - cloud[p][1], q[0] - cloud[p][0]);
    for (const double side : {-1.0, 1.0}) {
      const double angle = towards + side * (std::acos(d / (2.0 * alpha)) + 1e-9);
      const Planar centre{cloud[p][0] + alpha * std::cos(angle), cloud[p][1] + alpha * std::sin(angle)};
      const bool empty = std::none_of(cloud.begin(), cloud.end(), [&](const Planar& other) {
        return distance(other, cloud[p]) > 0.0 && distance(other, centre) < alpha - 1e-13;
      });
      if (empty) return true;
    }
  }
  return alone;
}

/// p is inside the alpha complex if the Delaunay triangles around it go all the way round and no circumcircle is larger
/// than alpha. For clouds in general position.
bool exposed_by_delaunay(const Cloud& cloud, std::size_t p, double alpha) {
  double turn = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t j = i + 1; j < cloud.size(); ++j) {
      if (i == p || j == p) continue;
      const Planar a{cloud[i][0] - cloud[p][0], cloud[i][1] - cloud[p][1]};
      const Planar b{cloud[j][0] - cloud[p][0], cloud[j][1] - cloud[p][1]};
      const double cross = a[0] * b[1] - a[1] * b[0];
      const double a2 = a[0] * a[0] + a[1] * a[1];
      const double b2 = b[0] * b[0] + b[1] * b[1];
      const Planar centre{cloud[p][0] + (b[1] * a2 - a[1] * b2) / (2.0 * cross),
                          cloud[p][1] + (a[0] * b2 - b[0] * a2) / (2.0 * cross)};
      const double radius = distance(centre, cloud[p]);
      bool empty = true;
      for (std::size_t k = 0; k < cloud.size() && empty; ++k) {
        empty = k == p || k == i || k == j || distance(cloud[k], centre) >= radius;
      }
      if (!empty) continue;
      if (radius > alpha) return true;
      turn += std::atan2(std::fabs(cross), a[0] * b[0] + a[1] * b[1]);
    }
  }
  return turn < 2.0 * kPi - 1e-6;
}

Cloud random_cloud(std::size_t points, double noise_across, std::uint64_t seed) {
  test::Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < points; ++i) cloud.push_back({random.in(0.0, 6.0), noise_across * random.in(0.0, 6.0)});
  return cloud;
}

TEST(AlphaExposure, RandomClouds_AgreeWithDiscsAndDelaunay) {
  int exposed = 0;
  int inside = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Cloud cloud = random_cloud(4 + seed % 40, seed % 3 == 0 ? 0.1 : 1.0, seed);
    for (const double alpha : {0.3, 0.8, 1.5, 4.0}) {
      for (std::size_t p = 0; p < cloud.size(); ++p) {
        const bool found = exposure_deg(cloud, p, alpha) > 0.0;
        EXPECT_EQ(found, exposed_by_discs(cloud, p, alpha)) << "seed " << seed << " alpha " << alpha << " point " << p;
        EXPECT_EQ(found, exposed_by_delaunay(cloud, p, alpha))
            << "seed " << seed << " alpha " << alpha << " point " << p;
        ++(found ? exposed : inside);
      }
    }
  }
  EXPECT_GT(exposed, 1000);
  EXPECT_GT(inside, 500);
}

TEST(AlphaExposure, Grids_AgreeWithDiscs) {
  Cloud cloud;
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 7; ++j) {
      if (i != 3 || j > 1) cloud.push_back({double(i), double(j)});
    }
  }
  for (const double alpha : {0.4, 0.6, 0.72, 1.0, 1.3, 2.0, 3.0}) {
    for (std::size_t p = 0; p < cloud.size(); ++p) {
      EXPECT_EQ(exposure_deg(cloud, p, alpha) > 0.0, exposed_by_discs(cloud, p, alpha)) << alpha << " point " << p;
    }
  }
}

TEST(AlphaExposure, CircumcircleOfExactlyAlpha_IsFilled) {
  // Inside a square grid all blocked directions meet end to end at alpha = s / sqrt(2).
  Cloud cloud;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) cloud.push_back({double(i), double(j)});
  }
  EXPECT_EQ(exposure_deg(cloud, 12, std::sqrt(0.5)), 0.0);
  EXPECT_GT(exposure_deg(cloud, 12, std::sqrt(0.5) * (1.0 - 1e-6)), 0.0);
  EXPECT_EQ(exposure_deg(cloud, 12, std::sqrt(0.5) * (1.0 + 1e-6)), 0.0);
}

TEST(AlphaExposure, StraightBorder_ShowsTheAngleOfItsSpacing) {
  Cloud cloud;
  for (int i = -8; i <= 8; ++i) {
    for (int j = 0; j <= 8; ++j) cloud.push_back({double(i), double(j)});
  }
  const auto origin = static_cast<std::size_t>(std::find(cloud.begin(), cloud.end(), Planar{0.0, 0.0}) - cloud.begin());
  for (const double alpha : {1.0, 2.0, 3.0}) {
    EXPECT_NEAR(exposure_deg(cloud, origin, alpha), 2.0 * std::asin(0.5 / alpha) * kDegreesPerRadian, 1e-9);
  }
}

TEST(AlphaExposure, FewAndCollinearPoints_AreAllExposed) {
  EXPECT_EQ(exposure_deg({{1.0, 1.0}}, 0, 1.0), 360.0);
  EXPECT_EQ(exposure_deg({{0.0, 0.0}, {3.0, 0.0}}, 0, 1.0), 360.0);
  EXPECT_NEAR(exposure_deg({{0.0, 0.0}, {1.0, 0.0}}, 0, 1.0), 240.0, 1e-9);
  for (std::size_t p = 0; p < 3; ++p) EXPECT_GT(exposure_deg({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}, p, 9.0), 0.0);
  Cloud line;
  for (int i = 0; i < 50; ++i) line.push_back({0.1 * i, -0.3 * i});
  for (std::size_t p = 0; p < line.size(); ++p) EXPECT_GT(exposure_deg(line, p, 5.0), 0.0);
}

TEST(AlphaExposure, CoincidentProjections_BlockNothing) {
  Cloud cloud = random_cloud(30, 1.0, 5);
  for (std::size_t p = 0; p < 30; ++p) {
    Cloud doubled = cloud;
    doubled.push_back(cloud[p]);
    EXPECT_EQ(exposure_deg(doubled, p, 0.9), exposure_deg(cloud, p, 0.9));
  }
}

TEST(AlphaExposure, OrderOfNeighbours_ChangesNoBit) {
  Cloud cloud = random_cloud(60, 1.0, 9);
  for (std::size_t p = 0; p < 10; ++p) {
    const Planar point = cloud[p];
    const double before = exposure_deg(cloud, p, 0.7);
    Cloud shuffled = cloud;
    test::shuffle(shuffled, p);
    const auto now = static_cast<std::size_t>(std::find(shuffled.begin(), shuffled.end(), point) - shuffled.begin());
    EXPECT_EQ(before, exposure_deg(shuffled, now, 0.7));
  }
}

}  // namespace
}  // namespace arris
