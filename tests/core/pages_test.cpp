#include "core/pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace arris {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

TEST(Pages, WhatIsReturned_IsTakenAgain) {
  drop_spare_pages();
  void* const first = take_pages(8 * kMiB);
  return_pages(first, 8 * kMiB);
  void* const again = take_pages(3 * kMiB);
  EXPECT_EQ(again, first);
  void* const rest = take_pages(4 * kMiB);
  EXPECT_GT(rest, first);
  EXPECT_LE(static_cast<char*>(rest) + 4 * kMiB, static_cast<char*>(first) + 8 * kMiB);
  return_pages(again, 3 * kMiB);
  return_pages(rest, 4 * kMiB);
  drop_spare_pages();
}

TEST(Pages, BlocksInUse_NeverOverlap) {
  const auto use = [](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<std::pair<PageVector<std::uint64_t>, std::uint64_t>> held;
    for (int turn = 0; turn < 400; ++turn) {
      if (held.size() > 6) {
        std::swap(held[random() % held.size()], held.back());
        const auto& [block, mark] = held.back();
        EXPECT_TRUE(std::ranges::all_of(block, [mark = mark](std::uint64_t v) { return v == mark; }));
        held.pop_back();
      }
      PageVector<std::uint64_t> block(1 + random() % (kMiB / 2));  // On both sides of what comes from the heap.
      const std::uint64_t mark = random();
      std::ranges::fill(block, mark);
      held.emplace_back(std::move(block), mark);
    }
  };
  std::thread other(use, 1);
  use(2);
  other.join();
  drop_spare_pages();
}

TEST(Pages, VectorsBehaveAsVectors) {
  PageVector<std::uint32_t> grown;
  for (std::uint32_t i = 0; i < 300'000; ++i) grown.push_back(i);
  grown.resize(200'000);
  EXPECT_EQ(grown.back(), 199'999U);
  PageVector<std::uint32_t> copy = grown;
  EXPECT_EQ(copy, grown);
  EXPECT_EQ(PageVector<std::uint32_t>(3, 7U), (PageVector<std::uint32_t>{7, 7, 7}));
}

}  // namespace
}  // namespace arris
