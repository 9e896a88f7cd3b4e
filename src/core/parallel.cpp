#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace arris {
namespace {

/// Bodies of one loop until one throws. The loop itself never sees an exception: TBB would then cancel loops nested in
/// bodies that still run, also those of destructors, and OpenVDB would leak the nodes of a tree that it frees there.
class LoopBodies {
 public:
  void run(const std::function<void(std::size_t, std::size_t)>& body, std::size_t begin, std::size_t end) {
    if (failed_) return;
    try {
      body(begin, end);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      failed_ = true;
    }
  }
  /// Call it once all bodies are done.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::exception_ptr error_;
};

thread_local bool on_own_thread = false;

void run_chunks(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  for (std::size_t begin = 0; begin < count; begin += grain) body(begin, std::min(count, begin + grain));
}

}  // namespace

OwnThreadLoops::OwnThreadLoops() {
  on_own_thread = true;
}
OwnThreadLoops::~OwnThreadLoops() {
  on_own_thread = false;
}

#if defined(__SANITIZE_THREAD__)
// ThreadSanitizer cannot see the synchronisation inside of Debian's libtbb and reports races there. In its builds loops
// run on plain threads, so that races of our own show, and TBB (which OpenVDB uses itself) stays on the calling thread.
namespace {
tbb::global_control& one_tbb_thread() {
  static tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  return control;
}
const tbb::global_control& applied_at_start = one_tbb_thread();
std::atomic<int> limit{0};  // 0: none is alive.
}  // namespace

struct ThreadLimit::Impl {
  explicit Impl(int threads) { limit = std::max(1, threads); }
  ~Impl() { limit = 0; }
};

int loop_threads() {
  if (on_own_thread) return 1;
  const int now = limit;
  return now > 0 ? now : 4;
}

void parallel_for_chunks(std::size_t count, std::size_t grain,
                         const std::function<void(std::size_t begin, std::size_t end)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  if (on_own_thread) return run_chunks(count, grain, body);
  std::atomic<std::size_t> next{0};
  LoopBodies bodies;
  const auto work = [&] {
    for (std::size_t begin = next.fetch_add(grain); begin < count; begin = next.fetch_add(grain)) {
      bodies.run(body, begin, std::min(count, begin + grain));
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < loop_threads(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  bodies.rethrow();
}
#else
namespace {
/// Loops of all threads run in one arena: with as many places as threads are allowed, of which callers and TBB's
/// threads take what is free, so that a lone loop has them all and loops side by side have one each.
std::atomic<tbb::task_arena*> limited_arena{nullptr};

tbb::task_arena& arena() {
  if (tbb::task_arena* const limited = limited_arena) return *limited;
  static tbb::task_arena unlimited;
  return unlimited;
}
}  // namespace

struct ThreadLimit::Impl {
  explicit Impl(int threads)
      : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(std::max(1, threads))),
        arena(std::max(1, threads)) {
    limited_arena = &arena;
  }
  ~Impl() { limited_arena = nullptr; }
  tbb::global_control control;
  tbb::task_arena arena;
};

int loop_threads() {
  if (on_own_thread) return 1;
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallel_for_chunks(std::size_t count, std::size_t grain,
                         const std::function<void(std::size_t begin, std::size_t end)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  if (on_own_thread) return run_chunks(count, grain, body);
  const std::size_t chunks = count / grain + (count % grain != 0);
  LoopBodies bodies;
  const auto loop = [&] {
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, chunks,
                        [&](std::size_t chunk) {
                          bodies.run(body, chunk * grain, std::min(count, (chunk + 1) * grain));
                        });
    });
  };
  arena().execute(loop);
  bodies.rethrow();
}
#endif

ThreadLimit::ThreadLimit(int threads) : impl_(std::make_unique<Impl>(threads)) {}
ThreadLimit::~ThreadLimit() = default;

int hardware_threads() {
  return std::max(1, tbb::info::default_concurrency());
}

}  // namespace arris
