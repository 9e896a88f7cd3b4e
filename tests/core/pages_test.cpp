#include "core/pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "core/process_memory.h"
#include "support/sanitizers.h"

namespace arris {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

void* take_written(std::size_t size_bytes) {
  void* const pages = take_pages(size_bytes);
  std::memset(pages, 1, size_bytes);
  return pages;
}

TEST(Pages, WhatIsReturned_IsTakenAgain) {
  drop_spare_pages();
  void* const first = take_written(10 * kMiB);
  return_pages(first, 10 * kMiB);
  void* const again = take_pages(5 * kMiB);
  EXPECT_EQ(again, first);
  void* const rest = take_pages(4 * kMiB);
  EXPECT_EQ(rest, static_cast<char*>(first) + 6 * kMiB);  // Begins at a large page of 2 MiB.
  return_pages(again, 5 * kMiB);
  return_pages(rest, 4 * kMiB);
  EXPECT_EQ(take_pages(10 * kMiB), first);  // What touches is one again.
  return_pages(first, 10 * kMiB);
  drop_spare_pages();
  EXPECT_EQ(spare_pages_bytes(), 0U);
}

TEST(Pages, BlocksOfLessThanTwoLargePages_ShareOne) {
  drop_spare_pages();
  void* const first = take_written(kMiB / 2);
  EXPECT_EQ(spare_pages_bytes(), 2 * kMiB - kMiB / 2);
  void* const second = take_written(kMiB);
  EXPECT_EQ(second, static_cast<char*>(first) + kMiB / 2);
  EXPECT_EQ(spare_pages_bytes(), kMiB / 2);
  return_pages(first, kMiB / 2);
  return_pages(second, kMiB);
  EXPECT_EQ(spare_pages_bytes(), 2 * kMiB);
  drop_spare_pages();
}

TEST(Pages, WhatWasNeverWritten_IsNotKept) {
  drop_spare_pages();
  void* const pages = take_pages(64 * kMiB);
  std::memset(pages, 1, 5 * kMiB);
  return_pages(pages, 64 * kMiB);
  EXPECT_GE(spare_pages_bytes(), 5 * kMiB);
  EXPECT_LE(spare_pages_bytes(), 6 * kMiB);
  drop_spare_pages();
}

TEST(Pages, TrimmingLeavesWhatIsAllowed) {
  drop_spare_pages();
  void* const first = take_written(10 * kMiB);
  void* const second = take_written(6 * kMiB);
  return_pages(first, 10 * kMiB);
  return_pages(second, 6 * kMiB);
  const std::uint64_t before = resident_bytes();
  trim_spare_pages(16 * kMiB);
  EXPECT_EQ(spare_pages_bytes(), 16 * kMiB);
  trim_spare_pages(5 * kMiB);
  EXPECT_LE(spare_pages_bytes(), 5 * kMiB);
  EXPECT_GT(spare_pages_bytes(), 2 * kMiB);
  if (!test::kThreadSanitizer) {
    EXPECT_LT(resident_bytes(), before - 10 * kMiB);
  }
  trim_spare_pages(0);
  EXPECT_EQ(spare_pages_bytes(), 0U);
}

TEST(Pages, WhatDoesNotFit_GoesAsFarAsOtherPagesAreMade) {
  drop_spare_pages();
  std::array<void*, 16> blocks;
  for (void*& block : blocks) block = take_written(kMiB);
  for (std::size_t i = 0; i < blocks.size(); i += 2) return_pages(blocks[i], kMiB);
  EXPECT_EQ(spare_pages_bytes(), 8 * kMiB);
  void* const longer = take_written(3 * kMiB / 2);  // A large page is made: two of the stretches go, its rest is spare.
  EXPECT_EQ(spare_pages_bytes(), 13 * kMiB / 2);
  void* const next = take_written(3 * kMiB / 2);
  EXPECT_EQ(spare_pages_bytes(), 9 * kMiB / 2);
  void* const third = take_written(3 * kMiB / 2);
  void* const fourth = take_written(3 * kMiB / 2);
  EXPECT_GE(spare_pages_bytes(), 4 * kMiB);  // So much stays: small blocks come and go.
  for (void* const block : {longer, next, third, fourth}) return_pages(block, 3 * kMiB / 2);
  for (std::size_t i = 1; i < blocks.size(); i += 2) return_pages(blocks[i], kMiB);
  drop_spare_pages();
}

TEST(Pages, StretchesTooShort_AreGathered) {
  drop_spare_pages();
  std::array<void*, 6> blocks;
  for (void*& block : blocks) block = take_written(8 * kMiB);
  for (std::size_t i = 0; i < blocks.size(); i += 2) return_pages(blocks[i], 8 * kMiB);
  EXPECT_EQ(spare_pages_bytes(), 24 * kMiB);
  const std::uint64_t before = resident_bytes();
  void* const gathered = take_written(24 * kMiB);
  EXPECT_EQ(spare_pages_bytes(), 0U);
  // ThreadSanitizer keeps memory of its own for all that moves.
  if (!test::kThreadSanitizer) {
    EXPECT_LT(resident_bytes(), before + 4 * kMiB);
  }
  void* const longer = take_written(16 * kMiB);  // Nothing is left: fresh.
  return_pages(gathered, 24 * kMiB);
  return_pages(longer, 16 * kMiB);
  void* const all = take_written(44 * kMiB);
  return_pages(all, 44 * kMiB);
  for (std::size_t i = 1; i < blocks.size(); i += 2) {
    EXPECT_EQ(static_cast<char*>(blocks[i])[8 * kMiB - 1], 1);
    return_pages(blocks[i], 8 * kMiB);
  }
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
