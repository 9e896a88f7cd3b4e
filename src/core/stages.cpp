#include "core/stages.h"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>

#include "core/at_work.h"
#include "core/parallel.h"

namespace arris {
namespace {

/// Plain threads, as for tasks in the background: what is to be done is large, and who has nothing to do must leave its
/// processor to the others, where threads of TBB would look for work again and again.
class StageRun {
 public:
  StageRun(std::size_t places, const std::function<bool(std::size_t)>& fill, const std::vector<Stage>& stages)
      : fill_(fill), stages_(stages), items_(places), free_(places) {
    std::iota(free_.rbegin(), free_.rend(), std::size_t{0});
  }

  void run(std::size_t threads) {
    threads_ = threads;
    std::vector<std::thread> others;
    try {
      for (std::size_t i = 1; i < threads; ++i) others.emplace_back([this] { work(); });
    } catch (...) {
      // Fewer threads do as well.
    }
    work();
    for (std::thread& thread : others) thread.join();
    if (error_) std::rethrow_exception(error_);
    if (fill_error_) std::rethrow_exception(fill_error_);
  }

 private:
  /// An item on its way: where it is, the stages it is through, and whether it is in the next one.
  struct Item {
    std::size_t place = 0;
    std::size_t through = 0;
    bool busy = false;
  };
  struct Step {
    std::uint64_t item = 0;
    bool fill = false;
  };

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      if (const std::optional<Step> step = next()) {
        lock.unlock();
        const bool filled = take(*step);
        lock.lock();
        end(*step, filled);
        changed_.notify_all();
      } else if (stopped_ || (ended_ && first_ == last_)) {
        return;
      } else {
        changed_.wait(lock);
      }
    }
  }

  /// Filling goes first, which only one can do and all others live on; then what has come furthest, whose place is
  /// wanted again. More than all threads can be at work at is filled by who would wait otherwise.
  std::optional<Step> next() {
    if (stopped_) return std::nullopt;
    const bool may_fill = !filling_ && !ended_ && last_ - first_ < items_.size();
    if (may_fill && last_ - first_ <= threads_) return fill_next();
    for (std::uint64_t item = first_; item < last_; ++item) {
      Item& now = at(item);
      if (now.busy || now.through == stages_.size()) continue;
      const bool in_turn = stages_[now.through].order == StageOrder::kInTurn;
      if (in_turn && item > first_ && at(item - 1).through <= now.through) continue;
      now.busy = true;
      return Step{item, false};
    }
    return may_fill ? std::optional(fill_next()) : std::nullopt;
  }
  Step fill_next() {
    filling_ = true;
    at(last_) = {free_.back(), 0, false};
    free_.pop_back();
    return {last_, true};
  }

  /// True unless there was nothing to fill a place with, or an error.
  bool take(const Step& step) {
    const AtWork at_work;
    // Nobody else changes what is known of an item that is busy or being filled.
    const Item& item = at(step.item);
    try {
      if (step.fill) return fill_(item.place);
      stages_[item.through].work(item.place);
      return true;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      std::exception_ptr& error = step.fill ? fill_error_ : error_;
      if (!error) error = std::current_exception();
      if (!step.fill) stopped_ = true;
      return false;
    }
  }

  void end(const Step& step, bool filled) {
    Item& item = at(step.item);
    if (step.fill) {
      filling_ = false;
      ended_ = !filled;
      if (filled) ++last_;
    } else {
      item.busy = false;
      if (++item.through == stages_.size()) free_.push_back(item.place);
    }
    while (first_ < last_ && at(first_).through == stages_.size()) ++first_;
  }

  Item& at(std::uint64_t item) { return items_[static_cast<std::size_t>(item % items_.size())]; }

  const std::function<bool(std::size_t)>& fill_;
  const std::vector<Stage>& stages_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t threads_ = 1;
  std::vector<Item> items_;             ///< Those of [first_, last_), and the one that is being filled.
  std::vector<std::size_t> free_;       ///< Places, the next one last.
  std::uint64_t first_ = 0, last_ = 0;  ///< Items that are on their way.
  bool filling_ = false, ended_ = false, stopped_ = false;
  std::exception_ptr error_, fill_error_;
};

}  // namespace

void run_stages(std::size_t places, const std::function<bool(std::size_t place)>& fill,
                const std::vector<Stage>& stages) {
  const std::size_t threads = std::min<std::size_t>(static_cast<std::size_t>(loop_threads()), places);
  if (threads > 1) return StageRun(places, fill, stages).run(threads);
  while (fill(0)) {
    for (const Stage& stage : stages) stage.work(0);
  }
}

}  // namespace arris
