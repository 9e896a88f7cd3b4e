// Items of a tree against sorting and plain loops.

#include "features/neighbourhood/tree_items.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "ball_testing.h"

namespace arris {
namespace {

std::vector<TreeItem> any_items(std::size_t count, std::int32_t extent, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<TreeItem> items(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::int32_t& at : items[i].at) {
      at = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(2 * extent) + 1)) - extent;
    }
    items[i].entry = static_cast<std::uint32_t>(i);
  }
  return items;
}

RC_GTEST_PROP(TreeItems, Selecting_LosesNoItemAndPartsThem, (std::uint64_t seed)) {
  const auto count = *rc::gen::inRange<std::size_t>(1, 700);
  const std::int32_t extent = *rc::gen::element(0, 3, 1000, 1 << 30);
  const auto nth = *rc::gen::inRange<std::size_t>(0, count);
  const int axis = *rc::gen::inRange(0, 3);
  const std::vector<TreeItem> before = any_items(count, extent, seed);
  std::vector<TreeItem> items = before;
  select_nth(items, nth, axis);
  std::vector<bool> seen(count);
  for (const TreeItem& item : items) {
    RC_ASSERT(item.entry < count);
    RC_ASSERT(!seen[item.entry]);
    seen[item.entry] = true;
    RC_ASSERT(std::equal(std::begin(item.at), std::end(item.at), std::begin(before[item.entry].at)));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool parted = i < nth ? items[i].at[axis] <= items[nth].at[axis] : items[i].at[axis] >= items[nth].at[axis];
    RC_ASSERT(parted);
  }
}

RC_GTEST_PROP(TreeItems, Box_IsTight, (std::uint64_t seed)) {
  const auto count = *rc::gen::inRange<std::size_t>(1, 40);
  const std::vector<TreeItem> items = any_items(count, 1000, seed);
  const ClosedBox box = box_of(items);
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(
        items.begin(), items.end(), [axis](const TreeItem& a, const TreeItem& b) { return a.at[axis] < b.at[axis]; });
    RC_ASSERT(box.min[axis] == low->at[axis]);
    RC_ASSERT(box.max[axis] == high->at[axis]);
  }
}

}  // namespace
}  // namespace arris
