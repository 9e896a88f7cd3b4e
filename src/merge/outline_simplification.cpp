#include "merge/outline_simplification.h"

#include <cmath>
#include <utility>

#include "merge/outline_plane.h"
#include "merge/outline_validity.h"

namespace arris::merge {
namespace {

double length2(const PlanePosition& a, const PlanePosition& b) {
  const auto x = static_cast<double>(b.x - a.x);
  const auto y = static_cast<double>(b.y - a.y);
  return x * x + y * y;
}

/// Squared distance of p from the segment a b.
double distance2(const PlanePosition& p, const PlanePosition& a, const PlanePosition& b) {
  const auto abx = static_cast<double>(b.x - a.x), aby = static_cast<double>(b.y - a.y);
  const auto apx = static_cast<double>(p.x - a.x), apy = static_cast<double>(p.y - a.y);
  const double ahead = abx * apx + aby * apy;
  const double whole = abx * abx + aby * aby;
  if (ahead <= 0.0 || whole == 0.0) return length2(a, p);
  if (ahead >= whole) return length2(b, p);
  const double across = abx * apy - aby * apx;
  return across * across / whole;
}

OutlineRing simplified(const OutlineRing& ring, const OutlinePlane& plane, double tolerance_units) {
  const std::size_t n = ring.size();
  std::vector<PlanePosition> at;
  for (const OutlineVertex& v : ring) at.push_back(plane(v.position));
  at.push_back(at[0]);
  std::size_t far = 1;
  for (std::size_t i = 2; i < n; ++i) {
    if (length2(at[0], at[i]) > length2(at[0], at[far])) far = i;
  }
  std::vector<std::uint8_t> kept(n + 1, 0);
  kept[0] = kept[far] = kept[n] = 1;
  std::vector<std::pair<std::size_t, std::size_t>> parts{{0, far}, {far, n}};
  while (!parts.empty()) {
    const auto [begin, end] = parts.back();
    parts.pop_back();
    std::size_t worst = begin;
    double worst2 = tolerance_units * tolerance_units;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double d2 = distance2(at[i], at[begin], at[end]);
      if (d2 > worst2) worst = i, worst2 = d2;
    }
    if (worst == begin) continue;
    kept[worst] = 1;
    parts.emplace_back(begin, worst);
    parts.emplace_back(worst, end);
  }
  OutlineRing fewer;
  for (std::size_t i = 0; i < n; ++i) {
    if (kept[i] != 0) fewer.push_back(ring[i]);
  }
  return fewer.size() < 3 ? ring : fewer;
}

}  // namespace

void simplify_outline(SegmentOutline& outline, const SegmentPlane& plane, const Lattice& lattice, double tolerance) {
  const OutlinePlane on_plane(plane);
  const double units = tolerance / (lattice.step * std::sqrt(on_plane.square_steps()));
  for (OutlinePolygon& polygon : outline.polygons) {
    OutlinePolygon fewer{simplified(polygon.outer, on_plane, units), {}, polygon.area};
    for (const OutlineRing& hole : polygon.holes) fewer.holes.push_back(simplified(hole, on_plane, units));
    if (is_valid(fewer, on_plane)) polygon = std::move(fewer);
  }
}

}  // namespace arris::merge
