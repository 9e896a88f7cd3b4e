#pragma once
/// @file The nearest truth edge of a point, exactly, among many edges.

#include <cstddef>
#include <limits>
#include <vector>

#include "evaluate/box_tree.h"
#include "evaluate/truth_edge.h"

namespace arris::evaluate {

/// Immutable; safe to query from several threads. Law: nearest(p).distance equals the smallest edge.distance(p) of all
/// edges.
class EdgeIndex {
 public:
  struct Nearest {
    std::size_t edge = 0;  ///< Index into edges(); the smallest among equally near ones.
    double distance = std::numeric_limits<double>::infinity();
  };

  explicit EdgeIndex(std::vector<TruthEdge> edges);

  const std::vector<TruthEdge>& edges() const { return edges_; }
  /// Infinite distance if there is no edge within `limit`.
  Nearest nearest(const Vec3& point, double limit = std::numeric_limits<double>::infinity()) const;

 private:
  /// Long edges have boxes that say little, so the tree holds pieces of them.
  struct Piece {
    std::size_t edge;
    Box3 box;
  };

  std::vector<TruthEdge> edges_;
  std::vector<Piece> pieces_;
  BoxTree tree_;
};

}  // namespace arris::evaluate
