#pragma once
/// @file A bounding volume tree over a fixed sequence of boxes, in the order given (best if neighbours in the sequence
/// are neighbours in space, as tiles and sorted cells are).

#include <algorithm>
#include <bit>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/lattice.h"

namespace arris::tiling {

/// Memory: 96 bytes per box. A walk visits O(log n + found) nodes for compact sequences. Safe to walk from several
/// threads.
class BoxTree {
 public:
  /// @param box_of(i)  the box of item i.
  BoxTree(std::size_t count, const std::function<LatticeBox(std::size_t)>& box_of)
      : count_(count), width_(std::bit_ceil(std::max<std::size_t>(count, 1))), nodes_(2 * width_) {
    for (std::size_t i = 0; i < count; ++i) nodes_[width_ + i] = box_of(i);
    for (std::size_t node = width_ - 1; node > 0; --node) {
      nodes_[node] = nodes_[2 * node];
      nodes_[node].include(nodes_[2 * node + 1]);
    }
  }

  /// Calls visit(box, begin, end) for nodes from the root down in ascending order: box bounds the items [begin, end); a
  /// node with end - begin == 1 is an item and visited once. The children of a node are visited only if visit returned
  /// true.
  template <typename Visit>
  void walk(Visit&& visit) const {
    walk(1, 0, width_, visit);
  }

 private:
  template <typename Visit>
  void walk(std::size_t node, std::size_t begin, std::size_t end, Visit& visit) const {
    if (begin >= count_) return;
    const std::size_t last = std::min(end, count_);
    if (!visit(nodes_[node], begin, last) || last - begin == 1) return;
    const std::size_t middle = begin + (end - begin) / 2;
    walk(2 * node, begin, middle, visit);
    walk(2 * node + 1, middle, end, visit);
  }

  std::size_t count_;
  std::size_t width_;
  std::vector<LatticeBox> nodes_;  // Heap order; items begin at width_.
};

}  // namespace arris::tiling
