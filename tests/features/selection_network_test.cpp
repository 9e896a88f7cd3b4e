// Compare-exchanges against sorting.

#include "features/segment/selection_network.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace arris {
namespace {

RC_GTEST_PROP(SelectionNetwork, AnyValues_ThatOfTheRankIsInItsPlace, ()) {
  const auto n = static_cast<std::size_t>(*rc::gen::inRange(1, 100));
  const auto rank = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(n)));
  std::vector<int> values = *rc::gen::container<std::vector<int>>(n, rc::gen::inRange(0, 50));
  std::vector<int> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [low, high] : selection_network(n, rank))
    if (values[high] < values[low]) std::swap(values[low], values[high]);
  RC_ASSERT(values[rank] == sorted[rank]);
}

}  // namespace
}  // namespace arris
