#include "features/segment/selection_network.h"

#include <algorithm>

#include "features/numerics/merge_exchange.h"

namespace arris {

std::vector<std::array<std::uint8_t, 2>> selection_network(std::size_t n, std::size_t rank) {
  std::vector<std::array<std::uint8_t, 2>> pairs;
  for_each_merge_exchange(n, [&pairs](std::size_t low, std::size_t high) {
    pairs.push_back({static_cast<std::uint8_t>(low), static_cast<std::uint8_t>(high)});
  });
  std::vector<bool> matters(n);
  matters[rank] = true;
  std::vector<std::array<std::uint8_t, 2>> needed;
  for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair) {
    const auto [low, high] = *pair;
    if (!matters[low] && !matters[high]) continue;
    matters[low] = matters[high] = true;
    needed.push_back(*pair);
  }
  std::reverse(needed.begin(), needed.end());
  return needed;
}

}  // namespace arris
