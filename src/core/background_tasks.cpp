#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/parallel.h"

namespace arris {

// Plain threads feed from one queue: a task blocks on the memory budget, and a blocked TBB worker could hold up a loop
// that another tile waits for. The loops inside the tasks are TBB's, so the processors stay shared fairly.
struct BackgroundTasks::Impl {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::function<void()>> queue;
  std::vector<std::thread> threads;
  std::size_t running = 0;
  std::exception_ptr error;
  bool stopping = false;

  void work() {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return stopping || !queue.empty(); });
      if (queue.empty()) return;
      std::function<void()> task = std::move(queue.front());
      queue.pop_front();
      if (error) {  // A failed run: the rest of the queue is dropped unseen.
        changed.notify_all();
        continue;
      }
      ++running;
      lock.unlock();
      std::exception_ptr thrown;
      try {
        task();
      } catch (...) {
        thrown = std::current_exception();
      }
      task = nullptr;
      lock.lock();
      --running;
      if (thrown && !error) error = thrown;
      changed.notify_all();
    }
  }
};

BackgroundTasks::BackgroundTasks(int threads) : impl_(std::make_unique<Impl>()) {
  for (int i = 0; i < std::max(1, threads); ++i) impl_->threads.emplace_back([impl = impl_.get()] { impl->work(); });
}

BackgroundTasks::~BackgroundTasks() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->stopping = true;
    impl_->queue.clear();  // Reached with work left only when an exception passes by.
  }
  impl_->changed.notify_all();
  for (std::thread& thread : impl_->threads) thread.join();
}

void BackgroundTasks::run(std::function<void()> task) {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->queue.push_back(std::move(task));
  }
  impl_->changed.notify_all();
}

void BackgroundTasks::wait() {
  std::unique_lock lock(impl_->mutex);
  impl_->changed.wait(lock, [&] { return impl_->queue.empty() && impl_->running == 0; });
  if (impl_->error) std::rethrow_exception(impl_->error);
}

bool BackgroundTasks::failed() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->error != nullptr;
}

}  // namespace arris
