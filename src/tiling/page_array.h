#pragma once
/// @file A large array whose pages the system makes when they are written to.

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

#include "core/pages.h"

namespace arris::tiling {

/// Up to `capacity` trivial elements, not initialised. Pages that were not written to take no memory; all go straight
/// back to the system. Throws std::bad_alloc.
template <class T>
class PageArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  PageArray() = default;
  explicit PageArray(std::size_t capacity) : data_(PageAllocator<T>().allocate(capacity), Free{capacity}) {}

  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }
  std::span<T> first(std::size_t count) { return {data_.get(), count}; }
  std::span<const T> first(std::size_t count) const { return {data_.get(), count}; }

 private:
  struct Free {
    std::size_t capacity = 0;
    void operator()(T* data) const { PageAllocator<T>().deallocate(data, capacity); }
  };
  std::unique_ptr<T[], Free> data_;
};

}  // namespace arris::tiling
