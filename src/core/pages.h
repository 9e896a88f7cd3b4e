#pragma once
/// @file Memory in whole pages, for arrays that are large and short-lived.

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace arris {

/// Blocks below this come from the heap.
constexpr std::size_t kLeastPagesBytes = std::size_t{128} << 10;

/// At least kLeastPagesBytes, not initialised: what was returned before, or straight from the system, which makes pages
/// when they are written to, large ones where it has them: blocks of less than two share one, the rest of which is
/// spare. Where nothing that was returned is long enough large pages from several places are put under one address, as
/// far as they go, so that hardly more (4 MiB) is resident than at some time was in use. Thread-safe. Throws
/// std::bad_alloc.
void* take_pages(std::size_t size_bytes);
/// Keeps the pages for the next who takes some: to have the system clear them again costs more than most uses.
/// @param size_bytes  as taken.
void return_pages(void* pages, std::size_t size_bytes) noexcept;
/// Gives back to the system what was returned; release_free_memory() does so.
void drop_spare_pages() noexcept;
/// Gives back what is more than that.
void trim_spare_pages(std::size_t most_bytes) noexcept;
/// What was returned and not taken again, and the rest of shared large pages.
std::size_t spare_pages_bytes() noexcept;

/// Writes to a byte of every page of a stretch, whatever was in it, so that the system makes them all now.
void touch_pages(void* begin, std::size_t size_bytes) noexcept;

/// Takes large blocks in pages, and leaves elements that are made without a value as they are, so that resize() writes
/// to nothing: whoever resizes fills.
template <class T>
struct PageAllocator {
  using value_type = T;
  PageAllocator() = default;
  template <class U>
  PageAllocator(const PageAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor): as allocators must.

  T* allocate(std::size_t count) {
    if (count * sizeof(T) < kLeastPagesBytes) return std::allocator<T>().allocate(count);
    return static_cast<T*>(take_pages(count * sizeof(T)));
  }
  void deallocate(T* data, std::size_t count) noexcept {
    if (count * sizeof(T) < kLeastPagesBytes) return std::allocator<T>().deallocate(data, count);
    return_pages(data, count * sizeof(T));
  }
  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const PageAllocator&, const PageAllocator&) { return true; }
};

template <class T>
using PageVector = std::vector<T, PageAllocator<T>>;

}  // namespace arris
