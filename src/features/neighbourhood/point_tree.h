#pragma once
/// @file A balanced kd-tree of buckets over the positions of one tile.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/pages.h"
#include "features/neighbourhood/outer_box.h"

namespace arris {

/// Positions sorted into 2^depth buckets of 16 to 32 points (fewer if there are fewer), bucket boxes tight. Buckets
/// that are close in number are close in space. Building takes O(n log n), in parallel; 24 bytes per point and about 4
/// per point for boxes. Reading is thread-safe. Nothing that is found may depend on the tree's shape, which depends on
/// the order of the entries.
class PointTree {
 public:
  PointTree(std::span<const LatticePoint> positions, std::span<const std::uint64_t> ids);

  std::size_t size() const { return x_.size(); }
  std::size_t buckets() const { return std::size_t{1} << depth_; }
  std::size_t bucket_begin(std::size_t bucket) const { return bucket * size() >> depth_; }

  /// Points in tree order.
  const std::int32_t* x() const { return x_.data(); }
  const std::int32_t* y() const { return y_.data(); }
  const std::int32_t* z() const { return z_.data(); }
  std::uint64_t id(std::size_t slot) const { return ids_[slot]; }
  /// Index into the positions that the tree was built from.
  std::uint32_t entry(std::size_t slot) const { return entries_[slot]; }
  LatticePoint position(std::size_t slot) const { return {x_[slot], y_[slot], z_[slot]}; }

  /// Calls visit(begin, end, box of the bucket) for every non-empty bucket whose box is within `reach` steps of `box`,
  /// and for some that are a little farther.
  template <class Visit>
  void visit_near(const ClosedBox& box, double reach, Visit&& visit) const {
    if (size() == 0) return;
    const OuterBox around(box);
    const auto limit = static_cast<float>(reach * reach * (1.0 + kBoxDistanceError));
    std::size_t stack[80];
    std::size_t top = 0;
    stack[top++] = 1;
    const std::size_t first_leaf = buckets();
    while (top > 0) {
      const std::size_t node = stack[--top];
      if (squared_distance(around, boxes_[node]) > limit) continue;
      if (node < first_leaf) {
        stack[top++] = 2 * node + 1;
        stack[top++] = 2 * node;
        continue;
      }
      const std::size_t bucket = node - first_leaf;
      const std::size_t begin = bucket_begin(bucket);
      const std::size_t end = bucket_begin(bucket + 1);
      if (begin < end) visit(begin, end, boxes_[node]);
    }
  }

 private:
  int depth_ = 0;
  PageVector<std::int32_t> x_, y_, z_;
  PageVector<std::uint32_t> entries_;
  PageVector<std::uint64_t> ids_;
  PageVector<OuterBox> boxes_;  ///< Heap order: node 1 is the root, children 2i and 2i + 1.
};

}  // namespace arris
