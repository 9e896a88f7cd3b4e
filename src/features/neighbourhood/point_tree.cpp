#include "features/neighbourhood/point_tree.h"

#include <algorithm>

#include "core/parallel.h"
#include "features/neighbourhood/tree_items.h"

namespace arris {
namespace {

constexpr std::size_t kBucketPoints = 32;

struct Builder {
  PageVector<TreeItem>& items;
  NodeBoxes& boxes;
  int depth;

  /// Splits node `node` of level `level` at its middle, so that everything below stays balanced.
  void split(std::size_t node, int level) const {
    const std::size_t number = node - (std::size_t{1} << level);
    const auto begin_of = [&](std::size_t n, int l) { return n * items.size() >> l; };
    const std::size_t begin = begin_of(number, level);
    const std::size_t end = begin_of(number + 1, level);
    if (begin == end) return;
    const ClosedBox box = box_of(std::span(items).subspan(begin, end - begin));
    boxes.set(node, OuterBox(box));
    if (level == depth) return;
    int axis = 0;
    std::int64_t longest = -1;
    for (int a = 0; a < 3; ++a) {
      const std::int64_t side = std::int64_t{box.max[a]} - box.min[a];
      if (side > longest) {
        longest = side;
        axis = a;
      }
    }
    const std::size_t middle = begin_of(2 * number + 1, level + 1);
    select_nth(std::span(items).subspan(begin, end - begin), middle - begin, axis);
  }

  void build_below(std::size_t node, int level) const {
    split(node, level);
    if (level == depth) return;
    build_below(2 * node, level + 1);
    build_below(2 * node + 1, level + 1);
  }
};

}  // namespace

PointTree::PointTree(std::span<const LatticePoint> positions, std::span<const std::uint64_t> ids) {
  const std::size_t n = positions.size();
  while ((n >> depth_) >= kBucketPoints) ++depth_;
  boxes_ = NodeBoxes(depth_);
  PageVector<TreeItem> items(n);
  for (std::size_t i = 0; i < n; ++i) {
    items[i] = {{positions[i].x, positions[i].y, positions[i].z}, static_cast<std::uint32_t>(i)};
  }
  const Builder builder{items, boxes_, depth_};
  // The first levels one after the other, their nodes in parallel; then whole subtrees in parallel, each in cache.
  const int shared_levels = std::min(depth_, 4);
  for (int level = 0; level < shared_levels; ++level) {
    const std::size_t first = std::size_t{1} << level;
    parallel_for_chunks(first, 1, [&](std::size_t begin, std::size_t) { builder.split(first + begin, level); });
  }
  const std::size_t first = std::size_t{1} << shared_levels;
  if (n > 0) {
    parallel_for_chunks(first, 1,
                        [&](std::size_t begin, std::size_t) { builder.build_below(first + begin, shared_levels); });
  }
  for (std::size_t bucket = 0; bucket < buckets(); ++bucket) {
    const OuterBox box = bucket_box(bucket);
    for (int axis = 0; axis < 3; ++axis) {
      longest_bucket_ = std::max(longest_bucket_, static_cast<double>(box.max[axis]) - box.min[axis]);
    }
  }
  x_.resize(n);
  y_.resize(n);
  z_.resize(n);
  entries_.resize(n);
  ids_.resize(n);
  parallel_for_chunks(n, std::size_t{1} << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      x_[i] = items[i].at[0];
      y_[i] = items[i].at[1];
      z_[i] = items[i].at[2];
      entries_[i] = items[i].entry;
      ids_[i] = ids[items[i].entry];
    }
  });
}

}  // namespace arris
