#include "features/neighbourhood/point_tree.h"

#include <algorithm>

#include "core/parallel.h"

namespace arris {
namespace {

constexpr std::size_t kBucketPoints = 32;

struct Item {
  std::int32_t at[3];
  std::uint32_t entry;
};

ClosedBox box_of(std::span<const Item> items) {
  ClosedBox box;
  for (int axis = 0; axis < 3; ++axis) box.min[axis] = box.max[axis] = items[0].at[axis];
  for (const Item& item : items) {
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], item.at[axis]);
      box.max[axis] = std::max(box.max[axis], item.at[axis]);
    }
  }
  return box;
}

/// Puts the items in front whose coordinate `before` holds for, without branches; returns how many.
template <class Before>
std::size_t part(std::span<Item> items, int axis, Before before) {
  std::size_t n = 0;
  std::size_t gap = 0;  // Its item is kept aside.
  const Item first = items[0];
  const std::size_t first_before = before(first.at[axis]);
  for (std::size_t i = 1; i < items.size(); ++i) {
    items[gap] = items[n];
    items[n] = items[i];
    gap = i;
    n += before(items[i].at[axis]);
  }
  items[gap] = items[n];
  items[n] = first;
  return n + first_before;
}

/// A coordinate that about `nth` of the items are below: a little more or fewer, so that what is left after parting by
/// it is most often the smaller part.
std::int32_t pivot_for(std::span<const Item> items, std::size_t nth, int axis) {
  constexpr std::size_t kMostSamples = 31;
  constexpr std::size_t kItemsPerSample = 16;
  std::int32_t samples[kMostSamples];
  const std::size_t count = std::clamp<std::size_t>(items.size() / kItemsPerSample, 5, kMostSamples);
  for (std::size_t i = 0; i < count; ++i) samples[i] = items[items.size() * (2 * i + 1) / (2 * count)].at[axis];
  const std::size_t margin = (count + 1) / 16;
  std::size_t rank = nth * count / items.size();
  rank = 2 * nth < items.size() ? std::min(rank + margin, count - 1) : rank - std::min(rank, margin);
  std::nth_element(samples, samples + rank, samples + count);
  return samples[rank];
}

/// As std::nth_element, but in most rounds no branch depends on an item.
void select(std::span<Item> items, std::size_t nth, int axis) {
  constexpr std::size_t kFew = 32;
  constexpr int kMostRounds = 64;  // Against orders that make every pivot a bad one.
  for (int round = 0; round < kMostRounds && items.size() > kFew; ++round) {
    const std::int32_t pivot = pivot_for(items, nth, axis);
    const std::size_t below = part(items, axis, [=](std::int32_t at) { return at < pivot; });
    if (nth < below) {
      items = items.first(below);
      continue;
    }
    const bool uneven = below < items.size() / 8;
    items = items.subspan(below);
    nth -= below;
    if (!uneven) continue;
    // Many may be equal to the pivot.
    const std::size_t equal = part(items, axis, [=](std::int32_t at) { return at == pivot; });
    if (nth < equal) return;
    items = items.subspan(equal);
    nth -= equal;
  }
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(nth), items.end(),
                   [axis](const Item& a, const Item& b) { return a.at[axis] < b.at[axis]; });
}

struct Builder {
  PageVector<Item>& items;
  PageVector<OuterBox>& boxes;
  int depth;

  /// Splits node `node` of level `level` at its middle, so that everything below stays balanced.
  void split(std::size_t node, int level) const {
    const std::size_t number = node - (std::size_t{1} << level);
    const auto begin_of = [&](std::size_t n, int l) { return n * items.size() >> l; };
    const std::size_t begin = begin_of(number, level);
    const std::size_t end = begin_of(number + 1, level);
    if (begin == end) return;
    const ClosedBox box = box_of(std::span(items).subspan(begin, end - begin));
    boxes[node] = OuterBox(box);
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
    select(std::span(items).subspan(begin, end - begin), middle - begin, axis);
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
  boxes_.assign(2 * buckets(), OuterBox{});
  PageVector<Item> items(n);
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
