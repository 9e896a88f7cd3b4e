#pragma once
/// @file Reading of the next while the last is used.

#include <array>
#include <cstddef>
#include <functional>

namespace arris {

/// One is used while two are filled or wait: with fewer, each would wait for the slower of both every time.
constexpr std::size_t kItemsAhead = 3;

/// Calls use(place) for every place that fill(place) fills, in order, until fill() returns false. Places, below
/// `places` (>= 1), are filled in turn, on another thread while those before are used, unless loops may use one thread
/// only. What fill() throws is thrown on after what was filled before has been used, what use() throws at once.
void fill_in_turn(std::size_t places, const std::function<bool(std::size_t place)>& fill,
                  const std::function<void(std::size_t place)>& use);

/// The same with items: nothing else that fill() and use() both touch may change.
template <class Item>
void read_ahead(const std::function<bool(Item& item)>& fill, const std::function<void(const Item& item)>& use) {
  std::array<Item, kItemsAhead> items;
  fill_in_turn(
      items.size(), [&](std::size_t place) { return fill(items[place]); },
      [&](std::size_t place) { use(items[place]); });
}

}  // namespace arris
