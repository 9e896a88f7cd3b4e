#include "core/at_work.h"

#include <gtest/gtest.h>

#if defined(__linux__)

#include <sched.h>

#include <thread>

namespace arris {
namespace {

cpu_set_t allowed() {
  cpu_set_t set;
  CPU_ZERO(&set);
  EXPECT_EQ(::sched_getaffinity(0, sizeof set, &set), 0);
  return set;
}

/// The calling thread goes there, and may then use `set` again.
void go_to(int processor, const cpu_set_t& set) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(processor, &one);
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  ASSERT_EQ(::sched_setaffinity(0, sizeof set, &set), 0);
}

template <class Body>
void on_another_thread(Body&& body) {
  std::thread thread(body);
  thread.join();
}

TEST(AtWork, OnAProcessorWhereAnotherIsAtWork_MovesToOneWithoutAndStaysFree) {
  const cpu_set_t before = allowed();
  if (CPU_COUNT(&before) < 2) GTEST_SKIP() << "one processor";
  // The system moves threads too, at any time: what we wait for comes soon.
  bool moved = false;
  for (int attempt = 0; attempt < 100 && !moved; ++attempt) {
    const int here = ::sched_getcpu();
    const AtWork first;
    on_another_thread([&] {
      go_to(here, before);
      const AtWork second;
      moved = ::sched_getcpu() != here;
      const cpu_set_t after = allowed();
      EXPECT_TRUE(CPU_EQUAL(&before, &after));
    });
  }
  EXPECT_TRUE(moved);
}

TEST(AtWork, WithoutAFreeProcessorThatItMayUse_StaysWhereItIs) {
  const int here = ::sched_getcpu();
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(here, &one);
  const AtWork first;
  on_another_thread([&] {
    go_to(here, one);
    const AtWork second;
    EXPECT_EQ(::sched_getcpu(), here);
    const cpu_set_t after = allowed();
    EXPECT_TRUE(CPU_EQUAL(&one, &after));
  });
}

/// Whoever takes itself for another, or one that is over for one at work, moves every time; the system seldom does.
TEST(AtWork, NestedOrAfterOthersAreOver_StaysWhereItIs) {
  const cpu_set_t before = allowed();
  if (CPU_COUNT(&before) < 2) GTEST_SKIP() << "one processor";
  bool stayed_nested = false, stayed_after = false;
  for (int attempt = 0; attempt < 100 && !(stayed_nested && stayed_after); ++attempt) {
    const int here = ::sched_getcpu();
    { const AtWork over; }
    on_another_thread([&] {
      go_to(here, before);
      const AtWork outer;
      stayed_after = stayed_after || ::sched_getcpu() == here;
      const int now = ::sched_getcpu();
      const AtWork inner;
      stayed_nested = stayed_nested || ::sched_getcpu() == now;
    });
  }
  EXPECT_TRUE(stayed_after);
  EXPECT_TRUE(stayed_nested);
}

}  // namespace
}  // namespace arris

#endif
