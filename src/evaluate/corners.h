#pragma once
/// @file Where truth edges meet or turn. Private to evaluate.

#include <vector>

#include "evaluate/box_tree.h"
#include "evaluate/truth_edge.h"

namespace arris::evaluate {

/// Places where ends of edges lie within `join` of each other and leave it in three or more directions (more than 10
/// degrees apart), or in two that turn by more than 30 degrees. The middle of an edge that others end at is no corner,
/// nor is a point of a closed edge. Edges shorter than `join` have no ends. O(n log n).
class Corners {
 public:
  /// @param join  > 0, data units.
  Corners(const std::vector<TruthEdge>& edges, double join);

  /// Some corners more than once: at every end that takes part.
  const std::vector<Vec3>& places() const { return places_; }
  bool within(const Vec3& point, double distance) const;

 private:
  std::vector<Vec3> places_;
  BoxTree tree_;
};

}  // namespace arris::evaluate
