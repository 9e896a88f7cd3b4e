#include "evaluate/edge_index.h"

#include <cmath>
#include <numbers>

#include "evaluate/unit_groups.h"

namespace arris::evaluate {

namespace {

constexpr double kPiecesAlongScene = 64.0;
constexpr double kArcPieceDeg = 15.0;
// Widens boxes by more than the rounding of point_at(), so that an edge never sticks out of its boxes.
constexpr double kRelativeMargin = 1e-12;

Box3 piece_box(const TruthEdge& edge, double from, double to) {
  Box3 box;
  box.include(edge.point_at(from));
  box.include(edge.point_at(to));
  const Vec3 largest{std::max(std::abs(box.min.x), std::abs(box.max.x)),
                     std::max(std::abs(box.min.y), std::abs(box.max.y)),
                     std::max(std::abs(box.min.z), std::abs(box.max.z))};
  double margin = kRelativeMargin * (norm(largest) + edge.length());
  if (edge.shape == TruthEdge::Shape::kArc) {
    // The bulge of an arc over its chord.
    const double half_rad = 0.5 * (to - from) * edge.sweep_deg * std::numbers::pi / 180.0;
    margin += norm(edge.start) * (1.0 - std::cos(half_rad));
  }
  return box.expanded(margin);
}

}  // namespace

EdgeIndex::EdgeIndex(std::vector<TruthEdge> edges, std::vector<double> units)
    : edges_(std::move(edges)), units_(std::move(units)) {
  if (units_.empty()) units_.assign(edges_.size(), 1.0);
  Box3 scene;
  for (const TruthEdge& edge : edges_) scene.include(piece_box(edge, 0.0, 1.0));
  const double piece_length = edges_.empty() ? 1.0 : norm(scene.max - scene.min) / kPiecesAlongScene;
  for (const UnitGroup& of_unit : group_by_unit(units_)) {
    Group& group = groups_.emplace_back();
    group.longest_unit = of_unit.longest;
    for (const std::uint32_t i : of_unit.items) {
      const double by_length = piece_length > 0.0 ? std::ceil(edges_[i].length() / piece_length) : 1.0;
      const double by_angle = std::ceil(edges_[i].sweep_deg / kArcPieceDeg);
      const int count = static_cast<int>(std::clamp(std::max(by_length, by_angle), 1.0, 2.0 * kPiecesAlongScene));
      for (int k = 0; k < count; ++k) {
        group.pieces.push_back({i, piece_box(edges_[i], static_cast<double>(k) / count, (k + 1.0) / count)});
      }
    }
    group.tree =
        BoxTree(group.pieces.size(), [&pieces = group.pieces](std::size_t i) -> const Box3& { return pieces[i].box; });
  }
}

EdgeIndex::Nearest EdgeIndex::nearest(const Vec3& point, double limit) const {
  Nearest best;
  for (const Group& group : groups_) {
    const auto squared_reach = [](double distance, double unit) { return distance * unit * (distance * unit); };
    double squared_limit = squared_reach(std::min(limit, best.distance), group.longest_unit);
    group.tree.search(point, squared_limit, [&](std::uint32_t item) {
      const Piece& piece = group.pieces[item];
      if (piece.box.squared_distance(point) > squared_limit) return;
      const double distance = edges_[piece.edge].distance(point) / units_[piece.edge];
      if (distance > limit || distance > best.distance || (distance == best.distance && piece.edge >= best.edge))
        return;
      best = {piece.edge, distance};
      squared_limit = std::min(squared_limit, squared_reach(distance, group.longest_unit));
    });
  }
  return best;
}

}  // namespace arris::evaluate
