#include "core/stages.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/parallel.h"

namespace arris {
namespace {

/// What the last of the stages sees of the numbers 1 to `count`: each times two, plus one.
std::vector<int> numbers_through(int count, int threads, std::size_t places) {
  const ThreadLimit limit(threads);
  std::vector<int> items(places), seen;
  int last = 0;
  const Stage twice{StageOrder::kAnyOrder, [&](std::size_t place) {
                      if (items[place] % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
                      items[place] *= 2;
                    }};
  const Stage plus_one{StageOrder::kInTurn, [&](std::size_t place) { ++items[place]; }};
  const Stage see{StageOrder::kInTurn, [&](std::size_t place) { seen.push_back(items[place]); }};
  const auto fill = [&](std::size_t place) {
    items[place] = ++last;
    return last <= count;
  };
  run_stages(places, fill, {twice, plus_one, see});
  return seen;
}

TEST(Stages, AnyThreadsAndPlaces_DoAllWorkToEveryItemInOrder) {
  for (const int threads : {1, 2, 4}) {
    for (const std::size_t places : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{6}}) {
      for (const int count : {0, 1, 300}) {
        std::vector<int> expected(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) expected[static_cast<std::size_t>(i)] = 2 * (i + 1) + 1;
        EXPECT_EQ(numbers_through(count, threads, places), expected) << threads << " threads, " << places << " places";
      }
    }
  }
}

TEST(Stages, LastStageInAnyOrder_FillsPlacesAgainWhenTheyAreFree) {
  const ThreadLimit limit(4);
  std::array<std::atomic<int>, 3> in_use{};
  std::atomic<int> worked = 0;
  int filled = 0;
  const auto fill = [&](std::size_t place) {
    EXPECT_EQ(in_use[place]++, 0);
    return ++filled <= 500;
  };
  run_stages(in_use.size(), fill, {{StageOrder::kAnyOrder, [&](std::size_t place) {
                                      ++worked;
                                      --in_use[place];
                                    }}});
  EXPECT_EQ(worked, 500);
}

TEST(Stages, StageInAnyOrder_WorksAtSeveralItemsAtATime) {
  const ThreadLimit limit(2);
  std::atomic<int> inside = 0;
  std::atomic<bool> met = false;
  int filled = 0;
  // Each waits for the other, as long as it takes within reason.
  const Stage meet{StageOrder::kAnyOrder, [&](std::size_t) {
                     ++inside;
                     for (int i = 0; i < 20'000 && !met; ++i) {
                       if (inside == 2) met = true;
                       std::this_thread::sleep_for(std::chrono::microseconds(500));
                     }
                     --inside;
                   }};
  run_stages(3, [&](std::size_t) { return ++filled <= 2; }, {meet});
  EXPECT_TRUE(met);
}

TEST(Stages, FailingFill_IsReportedAfterWhatWasFilledBefore) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    int filled = 0, used = 0;
    const auto fill = [&](std::size_t) {
      if (++filled == 4) throw std::runtime_error("unreadable");
      return true;
    };
    EXPECT_THROW(run_stages(3, fill, {{StageOrder::kInTurn, [&](std::size_t) { ++used; }}}), std::runtime_error);
    EXPECT_EQ(used, 3);
  }
}

TEST(Stages, FailingWork_IsReportedAndEndsIt) {
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    std::atomic<int> filled = 0;
    int used = 0;
    const auto fill = [&](std::size_t) {
      ++filled;
      return true;
    };
    const Stage nothing{StageOrder::kAnyOrder, [](std::size_t) {}};
    const Stage use{StageOrder::kInTurn, [&](std::size_t) {
                      if (++used == 3) throw std::runtime_error("full");
                    }};
    EXPECT_THROW(run_stages(3, fill, {nothing, use}), std::runtime_error);
    EXPECT_EQ(used, 3);
    EXPECT_LE(filled, 5) << "two used, three places";
  }
}

TEST(Stages, Loops_MayRunInside) {
  const ThreadLimit limit(2);
  std::array<std::vector<int>, 3> items;
  long sum = 0;
  int filled = 0;
  const auto fill = [&](std::size_t place) {
    items[place].assign(1000, ++filled);
    return filled <= 50;
  };
  const Stage count{StageOrder::kAnyOrder, [&](std::size_t place) {
                      parallel_for_chunks(1000, 100, [&](std::size_t begin, std::size_t end) {
                        for (std::size_t i = begin; i < end; ++i) items[place][i] += static_cast<int>(i);
                      });
                    }};
  const Stage add{StageOrder::kInTurn,
                  [&](std::size_t place) { sum += std::accumulate(items[place].begin(), items[place].end(), 0L); }};
  run_stages(items.size(), fill, {count, add});
  EXPECT_EQ(sum, 50L * 499'500 + 1000L * 1275);
}

}  // namespace
}  // namespace arris
