// Union-find, alone and by several threads, against components found by search.

#include "core/disjoint_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace arris {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs any_pairs(std::uint32_t elements, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Pairs pairs;
  for (std::size_t i = 0; i < count; ++i) pairs.emplace_back(random() % elements, random() % elements);
  return pairs;
}

/// The smallest element of each one's set: labels sink until none does.
std::vector<std::uint32_t> smallest_of(std::uint32_t elements, const Pairs& pairs) {
  std::vector<std::uint32_t> smallest(elements);
  std::iota(smallest.begin(), smallest.end(), 0U);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : pairs) {
      const std::uint32_t least = std::min(smallest[a], smallest[b]);
      changed |= smallest[a] != least || smallest[b] != least;
      smallest[a] = smallest[b] = least;
    }
  }
  return smallest;
}

std::vector<std::uint32_t> found_in(DisjointSets& sets) {
  std::vector<std::uint32_t> found(sets.size());
  for (std::uint32_t i = 0; i < found.size(); ++i) found[i] = sets.find(i);
  return found;
}

TEST(DisjointSets, TheSmallestElementStandsForItsSet) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Pairs pairs = any_pairs(500, 50 + 20 * seed, seed);
    DisjointSets sets(500);
    for (const auto& [a, b] : pairs) sets.join(a, b);
    EXPECT_EQ(found_in(sets), smallest_of(500, pairs)) << seed;
  }
  EXPECT_EQ(DisjointSets().size(), 0U);
}

TEST(DisjointSets, JoinedByTwoThreads_AreTheSame) {
  constexpr std::uint32_t kElements = 20'000;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Pairs pairs = any_pairs(kElements, kElements / 2 + 2000 * seed, seed);
    DisjointSets sets(kElements);
    const auto join = [&](std::size_t first) {
      for (std::size_t i = first; i < pairs.size(); i += 2) {
        sets.join(pairs[i].first, pairs[i].second);
        sets.find(pairs[pairs.size() - 1 - i].first);
      }
    };
    std::thread other(join, 1);
    join(0);
    other.join();
    EXPECT_EQ(found_in(sets), smallest_of(kElements, pairs)) << seed;
  }
}

}  // namespace
}  // namespace arris
