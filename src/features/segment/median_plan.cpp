#include <algorithm>

#include "features/segment/median_plane.h"

namespace arris {
namespace {

std::size_t triples_of(std::size_t n) {
  return n * (n - 1) * (n - 2) / 6;
}

std::vector<std::array<std::uint8_t, 3>> all_triples(std::size_t n) {
  std::vector<std::array<std::uint8_t, 3>> triples;
  for (std::uint8_t a = 0; a < n; ++a)
    for (std::uint8_t b = a + 1; b < n; ++b)
      for (std::uint8_t c = b + 1; c < n; ++c) triples.push_back({a, b, c});
  return triples;
}

/// Different triples whose members cover near and far neighbours alike, from a fixed sequence.
std::vector<std::array<std::uint8_t, 3>> spread_triples(std::size_t n) {
  std::vector<std::array<std::uint8_t, 3>> triples;
  std::uint64_t state = 0x9e3779b97f4a7c15U;
  const auto draw = [&state, n] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::uint8_t>((state >> 33) % n);
  };
  while (triples.size() < MedianPlan::kMostTriples) {
    std::array<std::uint8_t, 3> triple{draw(), draw(), draw()};
    std::sort(triple.begin(), triple.end());
    if (triple[0] == triple[1] || triple[1] == triple[2]) continue;
    if (std::find(triples.begin(), triples.end(), triple) == triples.end()) triples.push_back(triple);
  }
  return triples;
}

}  // namespace

MedianPlan::MedianPlan(std::size_t neighbours)
    : triples(triples_of(neighbours) <= kMostTriples ? all_triples(neighbours) : spread_triples(neighbours)) {}

}  // namespace arris
