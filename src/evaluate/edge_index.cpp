#include "evaluate/edge_index.h"

#include <cmath>
#include <numbers>

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

EdgeIndex::EdgeIndex(std::vector<TruthEdge> edges) : edges_(std::move(edges)) {
  Box3 scene;
  for (const TruthEdge& edge : edges_) scene.include(piece_box(edge, 0.0, 1.0));
  const double piece_length = edges_.empty() ? 1.0 : norm(scene.max - scene.min) / kPiecesAlongScene;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const double by_length = piece_length > 0.0 ? std::ceil(edges_[i].length() / piece_length) : 1.0;
    const double by_angle = std::ceil(edges_[i].sweep_deg / kArcPieceDeg);
    const int count = static_cast<int>(std::clamp(std::max(by_length, by_angle), 1.0, 2.0 * kPiecesAlongScene));
    for (int k = 0; k < count; ++k) {
      pieces_.push_back({i, piece_box(edges_[i], static_cast<double>(k) / count, (k + 1.0) / count)});
    }
  }
  tree_ = BoxTree(pieces_.size(), [this](std::size_t i) -> const Box3& { return pieces_[i].box; });
}

EdgeIndex::Nearest EdgeIndex::nearest(const Vec3& point, double limit) const {
  Nearest best;
  double squared_limit = limit * limit;
  tree_.search(point, squared_limit, [&](std::uint32_t piece) {
    if (pieces_[piece].box.squared_distance(point) > squared_limit) return;
    const std::size_t edge = pieces_[piece].edge;
    const double distance = edges_[edge].distance(point);
    if (distance > limit || distance > best.distance || (distance == best.distance && edge >= best.edge)) return;
    best = {edge, distance};
    squared_limit = std::min(squared_limit, distance * distance);
  });
  return best;
}

}  // namespace arris::evaluate
