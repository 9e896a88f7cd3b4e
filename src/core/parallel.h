#pragma once
/// @file The one place that includes TBB. Nothing here influences results: work items are independent, outputs are
/// indexed.

#include <cstddef>
#include <functional>
#include <memory>

namespace arris {

/// Caps the threads of everything run inside it, nested loops and OpenVDB's own included: loops of several callers
/// share them, and a lone loop has them all. At most one per process is alive.
class ThreadLimit {
 public:
  /// @param threads  >= 1.
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Threads the machine offers.
int hardware_threads();

/// How many threads a loop of the calling thread may use now.
int loop_threads();

/// Calls body(begin, end) over disjoint ranges that cover [0, count), each at most `grain` long (grain >= 1), in
/// parallel. The ranges are always [i*grain, min((i+1)*grain, count)): their cut does not depend on the number of
/// threads. Isolated: a thread that waits for its loop takes no task from outside of the loop. The first exception
/// thrown by a body is rethrown after the bodies that run then have ended, with whole loops nested in them; no other
/// body begins.
void parallel_for_chunks(std::size_t count, std::size_t grain,
                         const std::function<void(std::size_t begin, std::size_t end)>& body);

/// While one is alive, loops of the thread that made it run on that thread alone: work in the background of loops that
/// others wait for takes no place of theirs, and waits for none. They do not nest.
class OwnThreadLoops {
 public:
  OwnThreadLoops();
  ~OwnThreadLoops();
  OwnThreadLoops(const OwnThreadLoops&) = delete;
  OwnThreadLoops& operator=(const OwnThreadLoops&) = delete;
};

/// Runs independent tasks in the background while the caller goes on. wait() joins and rethrows the first exception.
///
/// Tasks run on at most `threads` threads at a time (the caller's thread does not count until it waits). A task may
/// block on a MemoryBudget and may use parallel_for_chunks; it never runs inside another task.
class BackgroundTasks {
 public:
  explicit BackgroundTasks(int threads);
  ~BackgroundTasks();  ///< Drops tasks not begun, waits for the others, swallows their exceptions: call wait() to see
                       ///< them.
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;

  void run(std::function<void()> task);
  void wait();
  /// True once a task has thrown; the caller may stop feeding.
  bool failed() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris
