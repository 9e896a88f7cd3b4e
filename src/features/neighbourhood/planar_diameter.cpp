#include "features/neighbourhood/planar_diameter.h"

#include <algorithm>
#include <utility>

namespace arris {
namespace {

double turn(const PlanarPoint& o, const PlanarPoint& a, const PlanarPoint& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Computed turns are off by less than this share of the squared extent.
constexpr double kTurnMargin = 1e-13;

double reach2(const std::vector<PlanarPoint>& points) {
  double reach2 = 0.0;
  for (const PlanarPoint& p : points) reach2 = std::max(reach2, p.x * p.x + p.y * p.y);
  return reach2;
}

double squared_length(const PlanarPoint& a, const PlanarPoint& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

bool canonical_less(const PlanarPoint& a, const PlanarPoint& b) {
  return a.d2 != b.d2 ? a.d2 < b.d2 : a.id < b.id;
}

/// Replaces sorted, distinct points by their hull, counter-clockwise, without collinear points.
void keep_hull(std::vector<PlanarPoint>& points, std::vector<PlanarPoint>& hull) {
  const std::size_t n = points.size();
  if (n < 3) return;
  hull.clear();
  const auto extend = [&hull](const PlanarPoint& p, std::size_t floor) {
    while (hull.size() >= floor + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
    hull.push_back(p);
  };
  for (std::size_t i = 0; i < n; ++i) extend(points[i], 0);
  const std::size_t upper = hull.size() - 1;
  for (std::size_t i = n - 1; i-- > 0;) extend(points[i], upper);
  hull.pop_back();
  points.swap(hull);
}

struct Longest {
  Diameter best;

  void offer(PlanarPoint a, PlanarPoint b) {
    const double length2 = squared_length(a, b);
    if (length2 < best.length2 || length2 == 0.0) return;
    if (canonical_less(b, a)) std::swap(a, b);
    if (length2 == best.length2) {
      if (canonical_less(best.a, a)) return;
      if (!canonical_less(a, best.a) && !canonical_less(b, best.b)) return;
    }
    best = {a, b, length2};
  }
};

}  // namespace

Diameter planar_diameter(std::vector<PlanarPoint>& points, std::vector<PlanarPoint>& hull) {
  std::sort(points.begin(), points.end(), [](const PlanarPoint& a, const PlanarPoint& b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return canonical_less(a, b);
  });
  const auto same_place = [](const PlanarPoint& a, const PlanarPoint& b) { return a.x == b.x && a.y == b.y; };
  points.erase(std::unique(points.begin(), points.end(), same_place), points.end());
  keep_hull(points, hull);
  Longest longest;
  const std::size_t h = points.size();
  if (h == 2) longest.offer(points[0], points[1]);
  if (h < 3) return longest.best;
  // For every edge the vertices farthest from it, which move forward only. All that are as far but for rounding, and
  // all on the way, are looked at: collinear places and places next to each other may all be vertices, as computed.
  const double margin = kTurnMargin * reach2(points);
  std::size_t opposite = 1;
  for (std::size_t i = 0; i < h; ++i) {
    const PlanarPoint& from = points[i];
    const PlanarPoint& to = points[(i + 1) % h];
    double farthest = turn(from, to, points[opposite]);
    for (std::size_t steps = 0, at = opposite; steps < h; ++steps, at = (at + 1) % h) {
      const double height = turn(from, to, points[at]);
      if (height < farthest - margin) break;
      if (height > farthest + margin) opposite = at;
      farthest = std::max(farthest, height);
      longest.offer(from, points[at]);
      longest.offer(to, points[at]);
    }
  }
  return longest.best;
}

}  // namespace arris
