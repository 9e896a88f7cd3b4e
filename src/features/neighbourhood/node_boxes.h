#pragma once
/// @file The boxes of the nodes of a balanced binary tree, eight side by side, and which of its leaves are near.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/pages.h"
#include "features/neighbourhood/outer_box.h"

namespace arris {

/// Nodes in heap order: 1 is the root, 2i and 2i + 1 are the children of i, so that all that are three levels below a
/// node follow each other. 24 bytes per node. Reading is thread-safe, and so is setting different nodes.
class NodeBoxes {
 public:
  NodeBoxes() = default;
  /// For 2^depth leaves.
  explicit NodeBoxes(int depth);

  void set(std::size_t node, const OuterBox& box);
  OuterBox operator[](std::size_t node) const;

  /// Appends the leaves, counted from 0, in ascending order, whose box is within `reach` steps of `box`, and some that
  /// are a little farther. O(leaves found + depth).
  void leaves_near(const OuterBox& box, double reach, std::vector<std::uint32_t>& leaves) const;

 private:
  /// Of all nodes.
  const float* least(int axis) const { return sides_.data() + static_cast<std::size_t>(axis) * nodes_; }
  const float* most(int axis) const { return sides_.data() + static_cast<std::size_t>(axis + 3) * nodes_; }

  int depth_ = 0;
  std::size_t nodes_ = 0;
  PageVector<float> sides_;  ///< The least coordinates along x of all nodes, along y, along z, then the greatest.
};

}  // namespace arris
