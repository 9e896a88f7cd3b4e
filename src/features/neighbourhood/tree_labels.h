#pragma once
/// @file Labels in the order of a tree.

#include <cstdint>
#include <span>

#include "core/pages.h"
#include "core/parallel.h"
#include "features/neighbourhood/point_tree.h"

namespace arris {

/// @param labels  per entry of what the tree was built from.
inline PageVector<std::uint32_t> in_tree_order(const PointTree& tree, std::span<const std::uint32_t> labels) {
  PageVector<std::uint32_t> ordered(tree.size());
  parallel_for_chunks(ordered.size(), std::size_t{1} << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) ordered[slot] = labels[tree.entry(slot)];
  });
  return ordered;
}

}  // namespace arris
