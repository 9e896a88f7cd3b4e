#pragma once
/// @file The boxes of the nodes of a balanced binary tree, eight side by side, and which of its leaves are near.

#include <array>
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
  int depth_ = 0;
  std::array<PageVector<float>, 3> min_, max_;
};

}  // namespace arris
