#pragma once
/// @file Union-find: which elements belong together after some pairs were joined.

#include <cstdint>
#include <numeric>
#include <utility>

#include "core/pages.h"

namespace arris {

/// Sets of 0 .. n - 1. The representative of a set is its smallest element, whatever the order of joining. Not
/// thread-safe. O(log n) amortised per call, 4 bytes per element.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::size_t size() const { return parent_.size(); }
  /// Adds elements, each on its own.
  void grow(std::size_t count) {
    const std::size_t old = parent_.size();
    parent_.resize(old + count);
    std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(old), parent_.end(), static_cast<std::uint32_t>(old));
  }
  /// An element of the same set. If it is the representative nothing needs to be looked for.
  std::uint32_t parent(std::uint32_t element) const { return parent_[element]; }
  std::uint32_t find(std::uint32_t element) {
    while (parent_[element] != element) {
      parent_[element] = parent_[parent_[element]];
      element = parent_[element];
    }
    return element;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  PageVector<std::uint32_t> parent_;
};

}  // namespace arris
