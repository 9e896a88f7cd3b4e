#pragma once
/// @file A large array whose pages the system makes when they are written to.

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

namespace arris::tiling {

/// Memory that is not initialised: pages straight from the system and straight back, large ones where it has them;
/// small blocks come from the heap. Throws std::bad_alloc.
class Pages {
 public:
  Pages() = default;
  explicit Pages(std::size_t size_bytes);
  Pages(Pages&& other) noexcept { swap(other); }
  Pages& operator=(Pages&& other) noexcept {
    Pages(std::move(other)).swap(*this);
    return *this;
  }
  ~Pages() { free(); }

  void* data() const { return data_; }

 private:
  static constexpr std::size_t kLeastMapped = std::size_t{128} << 10;
  void swap(Pages& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(mapped_, other.mapped_);
    std::swap(mapped_bytes_, other.mapped_bytes_);
    small_.swap(other.small_);
  }
  void free() noexcept;

  void* data_ = nullptr;
  void* mapped_ = nullptr;
  std::size_t mapped_bytes_ = 0;
  std::unique_ptr<std::byte[]> small_;
};

/// Up to `capacity` trivial elements, not initialised. Pages that were not written to take no memory.
template <class T>
class PageArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  PageArray() = default;
  explicit PageArray(std::size_t capacity) : pages_(capacity * sizeof(T)), data_(static_cast<T*>(pages_.data())) {}
  PageArray(PageArray&& other) noexcept : pages_(std::move(other.pages_)), data_(std::exchange(other.data_, nullptr)) {}
  PageArray& operator=(PageArray&& other) noexcept {
    pages_ = std::move(other.pages_);
    data_ = std::exchange(other.data_, nullptr);
    return *this;
  }

  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  std::span<T> first(std::size_t count) { return {data_, count}; }
  std::span<const T> first(std::size_t count) const { return {data_, count}; }

 private:
  Pages pages_;
  T* data_ = nullptr;
};

}  // namespace arris::tiling
