#pragma once
/// @file Union-find: which elements belong together after some pairs were joined.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/pages.h"

namespace arris {

/// Sets of 0 .. n - 1. The representative of a set is its smallest element, whatever the order of joining. Any threads
/// may join and find at the same time; what find() gives then may be a representative of before. O(log n) amortised per
/// call, 4 bytes per element.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::size_t size() const { return parent_.size(); }
  /// Adds elements, each on its own; while no other thread does anything.
  void grow(std::size_t count) {
    const std::size_t old = parent_.size();
    parent_.resize(old + count);
    std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(old), parent_.end(), static_cast<std::uint32_t>(old));
  }
  /// An element of the same set. If it is the representative nothing needs to be looked for.
  std::uint32_t parent(std::uint32_t element) const {
    return std::atomic_ref(const_cast<std::uint32_t&>(parent_[element])).load(std::memory_order_relaxed);
  }
  /// Shortens the way for the next. A parent is always smaller, in the same set, and never one's own again: whichever
  /// of several threads writes last, the way leads on to the representative.
  std::uint32_t find(std::uint32_t element) {
    for (std::uint32_t above = parent(element); above != element;) {
      const std::uint32_t next = parent(above);
      if (next == above) return above;
      std::atomic_ref(parent_[element]).store(next, std::memory_order_relaxed);
      element = next;
      above = parent(element);
    }
    return element;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (b < a) std::swap(a, b);
      std::uint32_t own = b;  // Unless another thread has joined it with something meanwhile.
      if (std::atomic_ref(parent_[b]).compare_exchange_strong(own, a, std::memory_order_relaxed)) return;
    }
  }

 private:
  PageVector<std::uint32_t> parent_;
};

}  // namespace arris
