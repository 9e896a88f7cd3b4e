#include "core/read_ahead.h"

#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "core/at_work.h"
#include "core/parallel.h"

namespace arris {
namespace {

/// What both sides know of each other.
class Turns {
 public:
  explicit Turns(std::size_t places) : places_(places) {}

  /// Waits for a place that may be filled; false if there is no use for more.
  bool may_fill() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return stopped_ || filled_ - used_ < places_; });
    return !stopped_;
  }
  void filled() {
    change([&] { ++filled_; });
  }
  void ended() {
    change([&] { ended_ = true; });
  }

  /// Waits for a place that may be used; false if none comes.
  bool may_use() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ended_ || used_ < filled_; });
    return used_ < filled_;
  }
  void used() {
    change([&] { ++used_; });
  }
  void stop() {
    change([&] { stopped_ = true; });
  }

 private:
  template <class Change>
  void change(Change&& what) {
    {
      const std::lock_guard lock(mutex_);
      what();
    }
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t places_;
  std::uint64_t filled_ = 0, used_ = 0;
  bool ended_ = false, stopped_ = false;
};

void fill_all(Turns& turns, std::size_t places, const std::function<bool(std::size_t place)>& fill) {
  try {
    for (std::uint64_t i = 0; turns.may_fill(); ++i) {
      const AtWork at_work;
      if (!fill(i % places)) break;
      turns.filled();
    }
  } catch (...) {
    turns.ended();
    throw;
  }
  turns.ended();
}

}  // namespace

void fill_in_turn(std::size_t places, const std::function<bool(std::size_t place)>& fill,
                  const std::function<void(std::size_t place)>& use) {
  if (loop_threads() == 1) {
    while (fill(0)) use(0);
    return;
  }
  Turns turns(places);
  BackgroundTasks filling(1);  // Declared after what its task uses: it is joined first.
  filling.run([&] { fill_all(turns, places, fill); });
  try {
    for (std::uint64_t i = 0; turns.may_use(); ++i) {
      const AtWork at_work;
      use(i % places);
      turns.used();
    }
  } catch (...) {
    turns.stop();
    throw;
  }
  filling.wait();
}

}  // namespace arris
