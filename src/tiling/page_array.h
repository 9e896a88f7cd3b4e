#pragma once
/// @file A large array whose pages the system makes when they are written to.

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

namespace arris::tiling {

/// Memory of whole pages, not initialised; large pages where the system has them. Throws std::bad_alloc.
void* allocate_pages(std::size_t size_bytes);
void free_pages(void* pages);

/// Up to `capacity` trivial elements. Pages that were not written to take no memory, and all go back to the system on
/// destruction.
template <class T>
class PageArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  PageArray() = default;
  explicit PageArray(std::size_t capacity) : data_(static_cast<T*>(allocate_pages(capacity * sizeof(T)))) {}

  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }
  std::span<T> first(std::size_t count) { return {data_.get(), count}; }
  std::span<const T> first(std::size_t count) const { return {data_.get(), count}; }

 private:
  struct Free {
    void operator()(T* data) const { free_pages(data); }
  };
  std::unique_ptr<T[], Free> data_;
};

}  // namespace arris::tiling
