#include "core/at_work.h"

#if defined(__linux__)

#include <sched.h>

#include <array>
#include <atomic>

namespace arris {
namespace {

/// Threads at work by the processor that they began on. Only hints: who moves them meanwhile is the system.
std::array<std::atomic<int>, CPU_SETSIZE> at_work{};

thread_local int depth = 0;
thread_local int processor = -1;

bool is_known(int number) {
  return number >= 0 && number < CPU_SETSIZE;
}

void begin_on(int number) {
  processor = number;
  at_work[static_cast<std::size_t>(number)].fetch_add(1, std::memory_order_relaxed);
}
void end() {
  at_work[static_cast<std::size_t>(processor)].fetch_sub(1, std::memory_order_relaxed);
  processor = -1;
}

/// To a processor that nobody is at work on.
void move() {
  cpu_set_t allowed, free;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  CPU_ZERO(&free);
  for (int number = 0; number < CPU_SETSIZE; ++number) {
    if (CPU_ISSET(number, &allowed) && at_work[static_cast<std::size_t>(number)].load(std::memory_order_relaxed) == 0)
      CPU_SET(number, &free);
  }
  if (CPU_COUNT(&free) == 0 || ::sched_setaffinity(0, sizeof free, &free) != 0) return;
  static_cast<void>(::sched_setaffinity(0, sizeof allowed, &allowed));
  const int now = ::sched_getcpu();
  if (!is_known(now)) return;
  end();
  begin_on(now);
}

}  // namespace

AtWork::AtWork() noexcept {
  if (depth++ > 0) return;
  const int number = ::sched_getcpu();
  if (!is_known(number)) return;
  begin_on(number);
  if (at_work[static_cast<std::size_t>(number)].load(std::memory_order_relaxed) > 1) move();
}

AtWork::~AtWork() {
  if (--depth == 0 && processor >= 0) end();
}

}  // namespace arris

#else

namespace arris {
AtWork::AtWork() noexcept = default;
AtWork::~AtWork() = default;
}  // namespace arris

#endif
