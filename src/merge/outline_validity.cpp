#include "merge/outline_validity.h"

#include <algorithm>

#include "merge/loop_containment.h"
#include "merge/outline_loops.h"

namespace arris::merge {
namespace {

struct Side {
  PlanePosition a, b;
  std::uint64_t id_a, id_b;
  std::int64_t low, high;  ///< Along x.
};

int sign(Area area) {
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

/// In the closed segment a b, which p is in line with.
bool between(const PlanePosition& p, const PlanePosition& a, const PlanePosition& b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// True if the sides have a point in common that is not a vertex of both.
bool in_conflict(const Side& s, const Side& t) {
  const int s_a = sign(turn(t.a, t.b, s.a)), s_b = sign(turn(t.a, t.b, s.b));
  const int t_a = sign(turn(s.a, s.b, t.a)), t_b = sign(turn(s.a, s.b, t.b));
  if (s_a * s_b < 0 && t_a * t_b < 0) return true;
  const auto touches = [](int side, std::uint64_t id, const PlanePosition& p, const Side& other) {
    return side == 0 && id != other.id_a && id != other.id_b && between(p, other.a, other.b);
  };
  return touches(s_a, s.id_a, s.a, t) || touches(s_b, s.id_b, s.b, t) || touches(t_a, t.id_a, t.a, s) ||
         touches(t_b, t.id_b, t.b, s);
}

/// Rings one after the other, as loops.
struct Rings {
  std::vector<Loop> loops;
  std::vector<PlanePosition> at;
  std::vector<Side> sides;

  Rings(const OutlinePolygon& polygon, const OutlinePlane& plane) {
    add(polygon.outer, plane);
    for (const OutlineRing& hole : polygon.holes) add(hole, plane);
  }

 private:
  void add(const OutlineRing& ring, const OutlinePlane& plane) {
    const auto first = static_cast<std::uint32_t>(at.size());
    Loop loop;
    for (const OutlineVertex& v : ring) {
      loop.push_back(static_cast<std::uint32_t>(at.size()));
      at.push_back(plane(v.position));
    }
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t j = (i + 1) % ring.size();
      const PlanePosition &a = at[first + i], &b = at[first + j];
      sides.push_back({a, b, ring[i].id, ring[j].id, std::min(a.x, b.x), std::max(a.x, b.x)});
    }
    loops.push_back(std::move(loop));
  }
};

bool any_conflict(std::vector<Side>& sides) {
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) { return s.low < t.low; });
  std::vector<const Side*> active;
  for (const Side& side : sides) {
    std::erase_if(active, [&](const Side* other) { return other->high < side.low; });
    for (const Side* other : active) {
      if (in_conflict(side, *other)) return true;
    }
    active.push_back(&side);
  }
  return false;
}

}  // namespace

bool is_valid(const OutlinePolygon& polygon, const OutlinePlane& plane) {
  Rings rings(polygon, plane);
  if (any_conflict(rings.sides)) return false;
  const LoopContainment containment(rings.loops, rings.at);
  for (std::uint32_t l = 0; l < rings.loops.size(); ++l) {
    const Loop& loop = rings.loops[l];
    const Area area = loop.size() < 3 ? 0 : twice_area(loop, rings.at);
    if (l == 0 ? area <= 0 : area >= 0) return false;
    if (l == 0) continue;
    std::vector<std::uint32_t> holders = containment.around(loop[0], loop[1]);
    std::erase(holders, l);
    if (holders != std::vector<std::uint32_t>{0}) return false;
  }
  return true;
}

}  // namespace arris::merge
