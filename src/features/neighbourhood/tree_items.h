#pragma once
/// @file What a tree of points is built from: positions with their entries, halved along an axis again and again.

#include <cstddef>
#include <cstdint>
#include <span>

#include "features/neighbourhood/closed_box.h"

namespace arris {

struct TreeItem {
  std::int32_t at[3];
  std::uint32_t entry;
};

/// @param items  at least one.
ClosedBox box_of(std::span<const TreeItem> items);

/// As std::nth_element by the coordinate `axis`, but in most rounds no branch depends on an item. Which of the orders
/// that fulfil this comes out is up to the processor. O(n) expected.
/// @param nth  below items.size().
void select_nth(std::span<TreeItem> items, std::size_t nth, int axis);

}  // namespace arris
