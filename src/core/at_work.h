#pragma once
/// @file Threads at work on processors of their own.

namespace arris {

/// While one is alive, the thread that made it is at work. Where another is at work on its processor while others, of
/// those that it may use, have none, it moves to one of them first: systems wake a thread where it slept or where who
/// wakes it runs, and may leave two threads on one processor, each waiting for the other, beside an idle one for tens
/// of milliseconds. It stays free to go wherever it was before. Nested ones do nothing. Some 20 ns; a move takes as
/// long as a system call or two. Nothing is done where the system tells no processors.
class AtWork {
 public:
  AtWork() noexcept;
  ~AtWork();
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
};

}  // namespace arris
