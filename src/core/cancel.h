#pragma once
/// @file Cooperative cancellation, checked between batches and tiles.

#include <atomic>

namespace arris {

/// Set from any thread or from a signal handler; read by the pipeline. Thread-safe and async-signal-safe.
class CancelToken {
 public:
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  bool requested() const noexcept { return requested_.load(std::memory_order_relaxed); }
  /// Throws Cancelled if a stop was requested.
  void check() const;

 private:
  std::atomic<bool> requested_{false};
};

}  // namespace arris
