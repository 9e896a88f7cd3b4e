#pragma once
/// @file Admission of work by predicted bytes, so that the process stays within the budget the user set.

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace arris {

/// Memory the machine offers this process: the smaller of RAM and the cgroup limits.
struct MachineMemory {
  std::uint64_t size_bytes = 0;
  bool limited_by_cgroup = false;
};
MachineMemory machine_memory();

/// A counter of bytes that blocks until a reservation fits. Thread-safe.
///
/// Laws: (1) the sum of live reservations never exceeds capacity_bytes(); (2) a reservation is taken whole or not at
/// all, and a thread holds at most one while it waits for none, so waiting always ends.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t capacity_bytes) : capacity_bytes_(capacity_bytes) {}

  /// Releases its bytes on destruction.
  class Reservation {
   public:
    Reservation(MemoryBudget& budget, std::uint64_t size_bytes) : budget_(&budget), size_bytes_(size_bytes) {}
    Reservation(Reservation&& other) noexcept : budget_(other.budget_), size_bytes_(other.size_bytes_) {
      other.budget_ = nullptr;
    }
    Reservation(const Reservation&) = delete;
    Reservation& operator=(const Reservation&) = delete;
    Reservation& operator=(Reservation&&) = delete;
    ~Reservation() {
      if (budget_) budget_->release(size_bytes_);
    }

   private:
    MemoryBudget* budget_;
    std::uint64_t size_bytes_;
  };

  /// Blocks until size_bytes are free. Throws BudgetError at once if size_bytes exceeds the whole capacity.
  Reservation reserve(std::uint64_t size_bytes);

  std::uint64_t capacity_bytes() const { return capacity_bytes_; }

 private:
  void release(std::uint64_t size_bytes);

  const std::uint64_t capacity_bytes_;
  std::uint64_t used_bytes_ = 0;
  std::mutex mutex_;
  std::condition_variable freed_;
};

}  // namespace arris
