#include "merge/outline_rings.h"

#include <algorithm>

#include "merge/loop_containment.h"
#include "merge/outline_loops.h"

namespace arris::merge {
namespace {

struct Vertices {
  std::vector<OutlineVertex> all;  ///< Ascending ids.
  std::vector<PlanePosition> at;

  Vertices(std::span<const OutlineEdge> edges, const OutlinePlane& plane) {
    for (const OutlineEdge& e : edges) {
      all.push_back({e.from, e.from_position});
      all.push_back({e.to, e.to_position});
    }
    std::sort(all.begin(), all.end());
    const auto same = [](const OutlineVertex& a, const OutlineVertex& b) { return a.id == b.id; };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
    for (const OutlineVertex& v : all) at.push_back(plane(v.position));
  }
  std::uint32_t index(std::uint64_t id) const {
    const auto found = std::lower_bound(all.begin(), all.end(), id,
                                        [](const OutlineVertex& v, std::uint64_t wanted) { return v.id < wanted; });
    return static_cast<std::uint32_t>(found - all.begin());
  }
  OutlineRing ring(const Loop& loop) const {
    OutlineRing ring;
    ring.reserve(loop.size());
    for (const std::uint32_t v : loop) ring.push_back(all[v]);
    return ring;
  }
};

}  // namespace

SegmentOutline link_outline(std::span<const OutlineEdge> edges, const SegmentPlane& plane, const Lattice& lattice) {
  SegmentOutline outline;
  if (edges.empty()) return outline;
  outline.segment = edges[0].segment;
  const OutlinePlane on_plane(plane);
  const Vertices vertices(edges, on_plane);
  std::vector<IndexedEdge> indexed;
  indexed.reserve(edges.size());
  for (const OutlineEdge& e : edges) indexed.push_back({vertices.index(e.from), vertices.index(e.to)});
  std::sort(indexed.begin(), indexed.end());
  indexed.erase(std::unique(indexed.begin(), indexed.end()), indexed.end());

  std::vector<Loop> outer, holes;
  std::vector<Area> twice;  // Of outer loops.
  for (Loop& loop : link_loops(indexed, vertices.at)) {
    const Area area = twice_area(loop, vertices.at);
    if (area > 0) twice.push_back(area);
    if (area != 0) (area > 0 ? outer : holes).push_back(std::move(loop));
  }
  for (const Loop& loop : outer) outline.polygons.push_back({vertices.ring(loop), {}, 0.0});
  std::vector<Area> left = twice;
  const LoopContainment containment(outer, vertices.at);
  for (const Loop& hole : holes) {
    const std::vector<std::uint32_t> around = containment.around(hole[0], hole[1]);
    // Of loops inside of each other the smallest is the nearest.
    const auto nearest = std::min_element(around.begin(), around.end(),
                                          [&](std::uint32_t a, std::uint32_t b) { return twice[a] < twice[b]; });
    if (nearest == around.end()) continue;
    outline.polygons[*nearest].holes.push_back(vertices.ring(hole));
    left[*nearest] += twice_area(hole, vertices.at);
  }
  const double unit = 0.5 * on_plane.square_steps() * lattice.step * lattice.step;
  Area total = 0;
  for (std::size_t i = 0; i < outline.polygons.size(); ++i) {
    outline.polygons[i].area = static_cast<double>(left[i]) * unit;
    total += left[i];
  }
  outline.area = static_cast<double>(total) * unit;
  return outline;
}

std::vector<SegmentOutline> link_outlines(std::vector<OutlineEdge> edges, std::span<const SegmentPlane> planes,
                                          const Lattice& lattice) {
  std::sort(edges.begin(), edges.end());
  std::vector<SegmentOutline> outlines;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    while (end < edges.size() && edges[end].segment == edges[begin].segment) ++end;
    SegmentOutline outline = link_outline(std::span<const OutlineEdge>(edges).subspan(begin, end - begin),
                                          planes[edges[begin].segment - 1], lattice);
    if (!outline.polygons.empty()) outlines.push_back(std::move(outline));
    begin = end;
  }
  return outlines;
}

}  // namespace arris::merge
