#include "features/segment/selection_network.h"

#include <algorithm>

namespace arris {
namespace {

/// Batcher's merge exchange (Knuth, The Art of Computer Programming 3, algorithm 5.2.2 M), for any n: sorts.
std::vector<std::array<std::uint8_t, 2>> merge_exchange(std::size_t n) {
  std::vector<std::array<std::uint8_t, 2>> pairs;
  for (std::size_t p = 1; p < n; p *= 2) {
    for (std::size_t k = p; k >= 1; k /= 2) {
      for (std::size_t j = k % p; j + k < n; j += 2 * k) {
        for (std::size_t i = j; i < std::min(j + k, n - k); ++i) {
          if (i / (2 * p) == (i + k) / (2 * p))
            pairs.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i + k)});
        }
      }
    }
  }
  return pairs;
}

}  // namespace

std::vector<std::array<std::uint8_t, 2>> selection_network(std::size_t n, std::size_t rank) {
  std::vector<std::array<std::uint8_t, 2>> pairs = merge_exchange(n);
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
