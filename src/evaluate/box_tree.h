#pragma once
/// @file A balanced tree of axis-aligned boxes for exact nearest and within-radius searches over points or edges.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "evaluate/vec3.h"

namespace arris::evaluate {

struct Box3 {
  Vec3 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 max = -min;

  void include(const Vec3& p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  void include(const Box3& box) {
    include(box.min);
    include(box.max);
  }
  Box3 expanded(double by) const { return {min - Vec3{by, by, by}, max + Vec3{by, by, by}}; }
  double squared_distance(const Vec3& p) const {
    const double dx = std::max({min.x - p.x, 0.0, p.x - max.x});
    const double dy = std::max({min.y - p.y, 0.0, p.y - max.y});
    const double dz = std::max({min.z - p.z, 0.0, p.z - max.z});
    return dx * dx + dy * dy + dz * dz;
  }
};

/// Items 0 .. count-1, known by their boxes only. Build O(n log n), about 30 bytes per item. Immutable: safe to search
/// from several threads.
class BoxTree {
 public:
  BoxTree() = default;

  /// @param count   below 2^32.
  /// @param box_of  Box3(std::size_t item), finite.
  template <class BoxOf>
  BoxTree(std::size_t count, const BoxOf& box_of) : order_(count) {
    for (std::size_t i = 0; i < count; ++i) order_[i] = static_cast<std::uint32_t>(i);
    if (count > 0) build(0, static_cast<std::uint32_t>(count), box_of);
  }

  bool empty() const { return order_.empty(); }

  /// Calls visit(item) for a superset of the items within sqrt(limit) of p, near boxes first; visit may lower `limit`.
  template <class Visit>
  void search(const Vec3& p, double& limit, const Visit& visit) const {
    if (empty()) return;
    // Depth is at most log2(2^32 / kLeafItems) + 1; each level leaves at most one sibling waiting.
    std::array<std::pair<std::uint32_t, double>, 40> stack;
    std::size_t waiting = 0;
    stack[waiting++] = {0, nodes_[0].box.squared_distance(p)};
    while (waiting > 0) {
      const auto [index, squared] = stack[--waiting];
      if (squared > limit) continue;
      const Node& node = nodes_[index];
      if (node.right == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) visit(order_[i]);
        continue;
      }
      std::pair<std::uint32_t, double> near{index + 1, nodes_[index + 1].box.squared_distance(p)};
      std::pair<std::uint32_t, double> far{node.right, nodes_[node.right].box.squared_distance(p)};
      if (far.second < near.second) std::swap(near, far);
      stack[waiting++] = far;
      stack[waiting++] = near;
    }
  }

 private:
  static constexpr std::uint32_t kLeafItems = 8;

  struct Node {
    Box3 box;
    std::uint32_t begin = 0, end = 0;
    std::uint32_t right = 0;  ///< 0: leaf. The left child follows its parent.
  };

  template <class BoxOf>
  void build(std::uint32_t begin, std::uint32_t end, const BoxOf& box_of) {
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    Box3 box;
    for (std::uint32_t i = begin; i < end; ++i) box.include(box_of(order_[i]));
    nodes_[index].box = box;
    nodes_[index].begin = begin;
    nodes_[index].end = end;
    if (end - begin <= kLeafItems) return;
    const Vec3 size = box.max - box.min;
    double Vec3::*const axis = size.x >= size.y && size.x >= size.z ? &Vec3::x : size.y >= size.z ? &Vec3::y : &Vec3::z;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t i, std::uint32_t j) {
                       const Box3 a = box_of(i), b = box_of(j);
                       const double ca = a.min.*axis + a.max.*axis, cb = b.min.*axis + b.max.*axis;
                       return ca < cb || (ca == cb && i < j);
                     });
    build(begin, middle, box_of);
    nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
    build(middle, end, box_of);
  }

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace arris::evaluate
