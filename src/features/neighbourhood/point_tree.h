#pragma once
/// @file A balanced kd-tree of buckets over the positions of one tile.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/pages.h"
#include "features/neighbourhood/node_boxes.h"

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

  /// Appends the buckets, ascending, whose box is within `reach` steps of `box`, and some that are a little farther.
  void buckets_near(const ClosedBox& box, double reach, std::vector<std::uint32_t>& buckets) const {
    if (size() > 0) boxes_.leaves_near(OuterBox(box), reach, buckets);
  }
  OuterBox bucket_box(std::size_t bucket) const { return boxes_[buckets() + bucket]; }
  /// No bucket's box is longer along an axis, steps.
  double longest_bucket() const { return longest_bucket_; }

 private:
  int depth_ = 0;
  PageVector<std::int32_t> x_, y_, z_;
  PageVector<std::uint32_t> entries_;
  PageVector<std::uint64_t> ids_;
  NodeBoxes boxes_;
  double longest_bucket_ = 0.0;
};

}  // namespace arris
