#pragma once
/// @file Reading of the next while the last is used.

#include <functional>
#include <optional>
#include <utility>

#include "core/parallel.h"

namespace arris {

/// Calls use(item) for every item that fill(item) fills, in order, until fill() returns false. Two items are filled in
/// turn, on another thread while the one before is used, unless loops may use one thread only: nothing that fill() and
/// use() both touch may change. What either throws is thrown on.
template <class Item>
void read_ahead(const std::function<bool(Item& item)>& fill, const std::function<void(const Item& item)>& use) {
  Item now, next;
  if (loop_threads() == 1) {
    while (fill(now)) use(now);
    return;
  }
  bool more = fill(now);
  BackgroundTasks filling(1);  // Declared last: it is joined before anything that its task uses goes.
  while (more) {
    filling.run([&] { more = fill(next); });
    use(now);
    filling.wait();
    std::swap(now, next);
  }
}

}  // namespace arris
