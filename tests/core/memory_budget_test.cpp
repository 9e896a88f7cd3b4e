#include "core/memory_budget.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "core/error.h"

namespace arris {
namespace {

TEST(MemoryBudget, ReservationLargerThanTheWhole_IsRefusedAtOnce) {
  MemoryBudget budget(100);
  EXPECT_THROW(budget.reserve(101), BudgetError);
  EXPECT_NO_THROW(budget.reserve(100));
}

TEST(MemoryBudget, ManyThreads_NeverHoldMoreThanTheCapacity) {
  MemoryBudget budget(10);
  std::atomic<int> held{0};
  std::atomic<int> most{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 500; ++i) {
        const int bytes = 1 + (i + t) % 7;
        const auto reservation = budget.reserve(static_cast<std::uint64_t>(bytes));
        const int now = held.fetch_add(bytes) + bytes;
        int seen = most.load();
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
        held.fetch_sub(bytes);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(most.load(), 10);
  EXPECT_GT(most.load(), 0);
}

TEST(MachineMemory, IsPlausible) {
  EXPECT_GT(machine_memory().size_bytes, 64ULL * 1024 * 1024);
}

}  // namespace
}  // namespace arris
