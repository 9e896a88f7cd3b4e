#include "core/read_ahead.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "core/parallel.h"

namespace arris {
namespace {

struct Number {
  int value = 0;
};

/// What is used of the numbers 1 to `count`.
std::vector<int> numbers_used(int count, int threads) {
  const ThreadLimit limit(threads);
  std::vector<int> used;
  int last = 0;
  read_ahead<Number>(
      [&](Number& number) {
        number.value = ++last;
        return number.value <= count;
      },
      [&](const Number& number) { used.push_back(number.value); });
  return used;
}

TEST(ReadAhead, AnyThreads_UseEveryItemInOrder) {
  for (const int threads : {1, 2, 4}) {
    EXPECT_EQ(numbers_used(0, threads), std::vector<int>{});
    EXPECT_EQ(numbers_used(1, threads), std::vector<int>{1});
    std::vector<int> all(500);
    std::iota(all.begin(), all.end(), 1);
    EXPECT_EQ(numbers_used(500, threads), all);
  }
}

TEST(ReadAhead, FailingFill_IsReportedAfterWhatWasFilledBefore) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    int filled = 0, used = 0;
    const auto fill = [&](Number&) {
      if (++filled == 4) throw std::runtime_error("unreadable");
      return true;
    };
    EXPECT_THROW(read_ahead<Number>(fill, [&](const Number&) { ++used; }), std::runtime_error);
    EXPECT_EQ(used, 3);
  }
}

TEST(ReadAhead, FailingUse_IsReportedAndEndsIt) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    std::atomic<int> filled = 0;
    const auto fill = [&](Number&) {
      ++filled;
      return true;
    };
    int used = 0;
    const auto use = [&](const Number&) {
      if (++used == 3) throw std::runtime_error("full");
    };
    EXPECT_THROW(read_ahead<Number>(fill, use), std::runtime_error);
    EXPECT_EQ(used, 3);
    EXPECT_LE(filled, 5) << "two used, three places";
  }
}

}  // namespace
}  // namespace arris
