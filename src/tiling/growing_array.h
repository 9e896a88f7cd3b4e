#pragma once
/// @file An array that grows without a second copy of itself in memory.

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace arris::tiling {

/// For large arrays of trivial elements: grows by realloc(), which moves pages instead of bytes for large blocks, so
/// that growing never takes twice the memory, and pages that were not yet written to do not count.
template <class T>
class GrowingArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }
  T& back() { return data_.get()[size_ - 1]; }
  std::span<const T> span() const { return {data_.get(), size_}; }
  std::size_t memory_bytes() const { return size_ * sizeof(T); }

  void push_back(const T& value) {
    if (size_ == capacity_) reallocate(capacity_ + capacity_ / 2 + 64);
    data_.get()[size_++] = value;
  }
  void shrink_to_fit() {
    if (size_ > 0) reallocate(size_);
  }

 private:
  struct Free {
    void operator()(T* data) const { std::free(data); }
  };
  void reallocate(std::size_t capacity) {
    auto* const data = static_cast<T*>(std::realloc(static_cast<void*>(data_.get()), capacity * sizeof(T)));
    if (!data) throw std::bad_alloc();
    static_cast<void>(data_.release());
    data_.reset(data);
    capacity_ = capacity;
  }

  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace arris::tiling
