#pragma once
/// @file What threads need for a chunk of work and keep for the next one.

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace arris {

/// As many runners as threads ran at a time: to make their scratch memory grow anew for every chunk would cost more
/// than it saves. Thread-safe but for idle().
template <class Runner>
class RunnerPool {
 public:
  /// Calls use(runner) with one that nobody else uses, made by make() if there is none.
  template <class Make, class Use>
  void with_one(Make&& make, Use&& use) {
    std::unique_ptr<Runner> runner = take();
    if (!runner) runner.reset(new Runner(make()));
    use(*runner);
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(runner));
  }
  /// All, when nobody uses any.
  std::vector<std::unique_ptr<Runner>>& idle() { return idle_; }

 private:
  std::unique_ptr<Runner> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return nullptr;
    std::unique_ptr<Runner> runner = std::move(idle_.back());
    idle_.pop_back();
    return runner;
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<Runner>> idle_;
};

}  // namespace arris
