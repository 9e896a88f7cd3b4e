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
#include <optional>
#include <thread>
#include <vector>

#include "core/at_work.h"
#include "core/chunk_parts.h"

namespace arris {
namespace {

/// One loop, until a body throws. TBB never sees an exception: it would then cancel loops nested in bodies that still
/// run, also those of destructors, and OpenVDB would leak the nodes of a tree that it frees there.
class SharedLoop {
 public:
  using Body = std::function<void(std::size_t begin, std::size_t end)>;
  SharedLoop(std::size_t count, std::size_t grain, std::size_t threads, const Body& body)
      : count_(count),
        grain_(grain),
        chunks_(count / grain + (count % grain != 0)),
        parts_(chunks_, threads),
        body_(body) {}

  std::size_t chunks() const { return chunks_; }
  /// What the calling thread finds to do.
  void work(std::size_t thread) {
    while (const std::optional<std::size_t> chunk = parts_.take(thread)) run(*chunk * grain_);
  }
  /// Call it once all threads are through.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void run(std::size_t begin) {
    if (failed_) return;
    const AtWork at_work;
    try {
      body_(begin, std::min(count_, begin + grain_));
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      failed_ = true;
    }
  }

  std::size_t count_, grain_, chunks_;
  ChunkParts parts_;
  const Body& body_;
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
  if (on_own_thread || count <= grain) return run_chunks(count, grain, body);
  SharedLoop loop(count, grain, static_cast<std::size_t>(loop_threads()), body);
  std::vector<std::thread> threads;
  for (int i = 1; i < loop_threads(); ++i) threads.emplace_back([&loop, i] { loop.work(static_cast<std::size_t>(i)); });
  loop.work(0);
  for (std::thread& thread : threads) thread.join();
  loop.rethrow();
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
  if (on_own_thread || count <= grain) return run_chunks(count, grain, body);
  const auto threads = static_cast<std::size_t>(arena().max_concurrency());
  SharedLoop loop(count, grain, threads, body);
  arena().execute([&] {
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, std::min(threads, loop.chunks()), [&](std::size_t) {
        loop.work(static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()) % threads);
      });
    });
  });
  loop.rethrow();
}
#endif

ThreadLimit::ThreadLimit(int threads) : impl_(std::make_unique<Impl>(threads)) {}
ThreadLimit::~ThreadLimit() = default;

int hardware_threads() {
  return std::max(1, tbb::info::default_concurrency());
}

}  // namespace arris
