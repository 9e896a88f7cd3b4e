#include "evaluate/corners.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arris::evaluate {

namespace {

const double kSameDirection = std::cos(10.0 * std::numbers::pi / 180.0);
const double kTurn = -std::cos(30.0 * std::numbers::pi / 180.0);  // Of two leaving directions: straight on is -1.

struct End {
  Vec3 place;
  Vec3 leaving;  ///< Unit, along the edge away from the end.
};

std::vector<End> ends_of(const std::vector<TruthEdge>& edges, double shortest) {
  std::vector<End> ends;
  for (const TruthEdge& edge : edges) {
    if (edge.closed() || !(edge.length() > shortest)) continue;
    const Vec3 a = edge.point_at(0.0), b = edge.point_at(1.0);
    if (edge.shape == TruthEdge::Shape::kSegment) {
      const Vec3 along = normalized(b - a);
      ends.push_back({a, along});
      ends.push_back({b, -along});
    } else {
      ends.push_back({a, normalized(cross(edge.b, a - edge.a))});
      ends.push_back({b, normalized(cross(b - edge.a, edge.b))});
    }
  }
  return ends;
}

bool is_corner(const std::vector<Vec3>& leaving) {
  std::vector<Vec3> different;
  for (const Vec3& direction : leaving) {
    const bool known = std::any_of(different.begin(), different.end(),
                                   [&](const Vec3& other) { return dot(direction, other) > kSameDirection; });
    if (!known) different.push_back(direction);
  }
  return different.size() >= 3 || (different.size() == 2 && dot(different[0], different[1]) > kTurn);
}

}  // namespace

Corners::Corners(const std::vector<TruthEdge>& edges, double join) {
  const std::vector<End> ends = ends_of(edges, join);
  const BoxTree tree(ends.size(), [&](std::size_t i) { return Box3{ends[i].place, ends[i].place}; });
  std::vector<std::uint32_t> near;
  std::vector<Vec3> leaving;
  for (const End& end : ends) {
    near.clear();
    double limit = join * join;
    tree.search(end.place, limit, [&](std::uint32_t i) {
      const Vec3 apart = ends[i].place - end.place;
      if (dot(apart, apart) <= join * join) near.push_back(i);
    });
    std::sort(near.begin(), near.end());
    leaving.clear();
    for (const std::uint32_t i : near) leaving.push_back(ends[i].leaving);
    if (is_corner(leaving)) places_.push_back(end.place);
  }
  tree_ = BoxTree(places_.size(), [this](std::size_t i) { return Box3{places_[i], places_[i]}; });
}

bool Corners::within(const Vec3& point, double distance) const {
  bool found = false;
  double limit = distance * distance;
  tree_.search(point, limit, [&](std::uint32_t i) {
    const Vec3 apart = places_[i] - point;
    if (dot(apart, apart) > distance * distance) return;
    found = true;
    limit = 0.0;
  });
  return found;
}

}  // namespace arris::evaluate
