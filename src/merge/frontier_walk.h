#pragma once
/// @file A walk over frontier points that looks up the labels of all their neighbours.

#include <cstddef>
#include <cstdint>

#include "core/prefetch.h"
#include "merge/frontier_coding.h"
#include "merge/point_labels.h"

namespace arris::merge {

/// Calls use(index, point) for the points of a block in turn; the labels that the next ones look up are fetched
/// meanwhile: neighbours are far from each other in the order of ids.
template <class Use>
void for_each_point(const FrontierBlock& block, const PointLabels& labels, Use&& use) {
  constexpr std::size_t kAhead = 4;
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (i + kAhead < block.size()) {
      const FrontierPoint later = block.point(i + kAhead);
      prefetch(&labels[later.id]);
      for (const std::uint32_t neighbour : later.neighbours) prefetch(&labels[neighbour]);
    }
    use(i, block.point(i));
  }
}

}  // namespace arris::merge
