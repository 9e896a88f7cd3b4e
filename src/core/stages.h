#pragma once
/// @file A stream of items that go through several stages, each item on whichever thread is free.

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace arris {

enum class StageOrder {
  kInTurn,    ///< One item at a time, in the order in which they were filled.
  kAnyOrder,  ///< Several items at a time.
};

/// What is done to the item in a place.
struct Stage {
  StageOrder order = StageOrder::kInTurn;
  std::function<void(std::size_t place)> work;
};

/// Fills places below `places` (>= 1), one at a time, until fill() returns false, and does the work of all stages to
/// each item; a place is filled again when the last stage is through with its item, the one that was left last first.
/// As many threads as loops may use, the caller's among them, take turns at what can be done next, so that unequal
/// stages keep all of them busy: nobody waits while there is anything to do, and who waits does not spin. One item more
/// than there are threads is on its way mostly; other places are for when a stage in turn takes long for once. Work may
/// use loops, and must not wait for other work. What fill() throws is thrown on after what was filled before is
/// through, what work throws as soon as the work of others has ended.
void run_stages(std::size_t places, const std::function<bool(std::size_t place)>& fill,
                const std::vector<Stage>& stages);

/// Places for items, each kept by one item at a time.
constexpr std::size_t kItemPlaces = 6;
template <class Item>
using ItemPlaces = std::array<Item, kItemPlaces>;

}  // namespace arris
