#pragma once
/// @file The nearest truth edge of a point, exactly, among many edges.

#include <cstddef>
#include <limits>
#include <vector>

#include "evaluate/box_tree.h"
#include "evaluate/truth_edge.h"

namespace arris::evaluate {

/// Immutable; safe to query from several threads. Law: nearest(p).distance equals the smallest edge.distance(p) / unit
/// of all edges.
class EdgeIndex {
 public:
  struct Nearest {
    std::size_t edge = 0;  ///< Index into edges(); the smallest among equally near ones.
    double distance = std::numeric_limits<double>::infinity();  ///< In units of that edge.
  };

  /// @param units  what distances to each edge are measured in, data units, > 0; empty: 1 for all.
  explicit EdgeIndex(std::vector<TruthEdge> edges, std::vector<double> units = {});

  const std::vector<TruthEdge>& edges() const { return edges_; }
  /// Infinite distance if there is no edge within `limit` of its units.
  Nearest nearest(const Vec3& point, double limit = std::numeric_limits<double>::infinity()) const;

 private:
  /// Long edges have boxes that say little, so the trees hold pieces of them.
  struct Piece {
    std::size_t edge;
    Box3 box;
  };
  /// Edges of similar units.
  struct Group {
    std::vector<Piece> pieces;
    BoxTree tree;
    double longest_unit = 1.0;
  };

  std::vector<TruthEdge> edges_;
  std::vector<double> units_;
  std::vector<Group> groups_;
};

}  // namespace arris::evaluate
