// Border edges against a Delaunay triangulation made of all triples, and their laws where circles hold many points.

#include "features/planar/alpha_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "ball_testing.h"

namespace arris {
namespace {

using Planar = std::pair<std::int64_t, std::int64_t>;
using Cloud = std::vector<Planar>;
using Edges = std::set<std::pair<std::size_t, std::size_t>>;

Edges border_of(const Cloud& cloud, std::int64_t two_alpha) {
  Edges edges;
  AlphaEdges alpha_edges;
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    std::vector<PlanarNeighbour> around;
    for (std::size_t q = 0; q < cloud.size(); ++q) {
      if (q == p) continue;
      around.push_back(
          {cloud[q].first - cloud[p].first, cloud[q].second - cloud[p].second, static_cast<std::uint32_t>(q)});
    }
    for (const PlanarNeighbour& q : alpha_edges.leaving(around, two_alpha)) edges.emplace(p, q.index);
  }
  return edges;
}

/// Triangles with an empty circumcircle of at most alpha, and their edges that have no triangle on the other side. For
/// clouds in general position.
Edges border_by_delaunay(const Cloud& cloud, long double alpha) {
  Edges edges;
  const std::size_t n = cloud.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        const long double ax = cloud[j].first - cloud[i].first, ay = cloud[j].second - cloud[i].second;
        const long double bx = cloud[k].first - cloud[i].first, by = cloud[k].second - cloud[i].second;
        const long double cross = ax * by - ay * bx;
        if (cross == 0) continue;
        const long double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
        const long double x = (by * a2 - ay * b2) / (2 * cross), y = (ax * b2 - bx * a2) / (2 * cross);
        const long double r2 = x * x + y * y;
        if (r2 > alpha * alpha) continue;
        bool empty = true;
        for (std::size_t m = 0; m < n && empty; ++m) {
          if (m == i || m == j || m == k) continue;
          const long double dx = cloud[m].first - cloud[i].first - x, dy = cloud[m].second - cloud[i].second - y;
          empty = dx * dx + dy * dy >= r2;
        }
        if (!empty) continue;
        const std::size_t corners[4] = {i, cross > 0 ? j : k, cross > 0 ? k : j, i};
        for (int side = 0; side < 3; ++side) edges.emplace(corners[side], corners[side + 1]);
      }
    }
  }
  std::erase_if(edges, [all = edges](const auto& edge) { return all.count({edge.second, edge.first}) > 0; });
  return edges;
}

Cloud random_cloud(std::size_t points, std::int64_t extent, std::uint64_t seed) {
  test::Random random(seed);
  std::set<Planar> distinct;
  while (distinct.size() < points) {
    distinct.emplace(static_cast<std::int64_t>(random.in(0.0, static_cast<double>(extent))),
                     static_cast<std::int64_t>(random.in(0.0, static_cast<double>(extent))));
  }
  return {distinct.begin(), distinct.end()};
}

TEST(AlphaEdges, RandomClouds_AreTheBorderOfDelaunayTriangles) {
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::int64_t extent = seed % 2 == 0 ? 1000000 : std::int64_t{1} << 40;
    const Cloud cloud = random_cloud(3 + seed % 40, extent, seed);
    for (const int share : {3, 6, 12, 40}) {
      const std::int64_t two_alpha = extent * 2 / share;
      const Edges edges = border_of(cloud, two_alpha);
      EXPECT_EQ(edges, border_by_delaunay(cloud, 0.5L * static_cast<long double>(two_alpha)))
          << "seed " << seed << " share " << share;
      found += edges.size();
    }
  }
  EXPECT_GT(found, 1000U);
}

/// Leaving and arriving edges alternate around p.
bool alternates(const Cloud& cloud, const Edges& edges, std::size_t p) {
  std::vector<std::pair<double, bool>> around;
  for (const auto& [from, to] : edges) {
    if (from != p && to != p) continue;
    const Planar& q = cloud[from == p ? to : from];
    around.emplace_back(std::atan2(double(q.second - cloud[p].second), double(q.first - cloud[p].first)), from == p);
  }
  std::sort(around.begin(), around.end());
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (around[i].second == around[(i + 1) % around.size()].second) return false;
  }
  return true;
}

bool cross_each_other(const Cloud& cloud, const std::pair<std::size_t, std::size_t>& e,
                      const std::pair<std::size_t, std::size_t>& f) {
  const auto side = [&](std::size_t a, std::size_t b, std::size_t c) {
    const std::int64_t turn = (cloud[b].first - cloud[a].first) * (cloud[c].second - cloud[a].second) -
                              (cloud[b].second - cloud[a].second) * (cloud[c].first - cloud[a].first);
    return turn > 0 ? 1 : turn < 0 ? -1 : 0;
  };
  return side(e.first, e.second, f.first) * side(e.first, e.second, f.second) < 0 &&
         side(f.first, f.second, e.first) * side(f.first, f.second, e.second) < 0;
}

TEST(AlphaEdges, GridsWithHolesAndManyPointsOnCircles_KeepTheLaws) {
  // Radii of 2.5 and 5 steps have circles through 4 to 12 grid points (3, 4, 5), and so have halves of 10 and 26.
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Cloud cloud = random_cloud(5 + seed, 8 + static_cast<std::int64_t>(seed) / 12, seed);
    for (const std::int64_t two_alpha : {2, 4, 5, 6, 8, 10, 13, 26}) {
      const Edges edges = border_of(cloud, two_alpha);
      for (std::size_t p = 0; p < cloud.size(); ++p) {
        ASSERT_TRUE(alternates(cloud, edges, p)) << "seed " << seed << " two alpha " << two_alpha << " point " << p;
      }
      for (const auto& e : edges) {
        EXPECT_EQ(edges.count({e.second, e.first}), 0U);
        for (const auto& f : edges) {
          ASSERT_FALSE(cross_each_other(cloud, e, f)) << "seed " << seed << " two alpha " << two_alpha;
        }
      }
      found += edges.size();
    }
  }
  EXPECT_GT(found, 10000U);
}

TEST(AlphaEdges, CircleOfExactlyAlpha_IsFilled) {
  // Four points on a circle of radius 5: a square if alpha is 5, nothing if it is a trifle less.
  const Cloud cloud{{5000000, 0}, {-5000000, 0}, {3000000, 4000000}, {3000000, -4000000}};
  EXPECT_EQ(border_of(cloud, 10000000), (Edges{{0, 2}, {2, 1}, {1, 3}, {3, 0}}));
  EXPECT_EQ(border_of(cloud, 9999999).size(), 0U);
}

TEST(AlphaEdges, SquareGrid_HasItsOutlineCounterclockwise) {
  Cloud cloud;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) cloud.emplace_back(i, j);
  }
  const Edges edges = border_of(cloud, 4);
  EXPECT_EQ(edges.size(), 16U);
  std::int64_t twice_area = 0;
  for (const auto& [p, q] : edges) {
    twice_area += cloud[p].first * cloud[q].second - cloud[p].second * cloud[q].first;
  }
  EXPECT_EQ(twice_area, 32);
}

TEST(AlphaEdges, StringOfPoints_HasNoArea) {
  EXPECT_TRUE(border_of({{0, 0}, {10, 1}, {20, 0}, {30, 2}}, 25).empty());
  EXPECT_TRUE(border_of({{0, 0}, {10, 0}}, 25).empty());
  EXPECT_TRUE(border_of({{0, 0}}, 25).empty());
}

}  // namespace
}  // namespace arris
